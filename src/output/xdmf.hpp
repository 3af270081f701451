#pragma once
#include <cstdint>
#include <string>
#include <string_view>

/// The XDMF 3 text by which ParaView finds the frames: only what its Xdmf2 and Xdmf3 readers both read.
namespace cablenet::output {

/// What stands before the steps of a file.  @param name  of its one grid
std::string xdmf_head(std::string_view name);
extern const std::string_view xdmf_tail;

/// One time step: the mesh of mesh.h5 with the cables' fields of one frame.
/// @param group  the frame's data as FILE:/GROUP, FILE relative to the .xmf
std::string xdmf_cables(double time, std::int64_t nodes, std::int64_t elements, std::string_view group);
/// One time step: a vertex for each body with its fields of one frame.
std::string xdmf_bodies(double time, std::int64_t bodies, std::string_view group);

}   // namespace cablenet::output
