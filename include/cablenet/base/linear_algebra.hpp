#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

/// This header names the small fixed-size types that the project uses.
namespace cablenet {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

}   // namespace cablenet
