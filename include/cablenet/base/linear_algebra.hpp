#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

/// The project's small fixed-size types.
namespace cablenet {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

}   // namespace cablenet
