#pragma once
#include <cstdint>
#include <string>
#include <string_view>

/// ParaView finds the frames by XDMF 3 text.  The text has only what both its Xdmf2 and its Xdmf3 reader understand.
namespace cablenet::output {

/// The text before the steps of a file.  @param name  of the file's one grid
std::string xdmf_head(std::string_view name);
extern const std::string_view xdmf_tail;

/// The text of one time step: the mesh of mesh.h5 with the cables' fields of one frame.
/// @param group  the frame's data as FILE:/GROUP, FILE relative to the .xmf
std::string xdmf_cables(double time, std::int64_t nodes, std::int64_t elements, std::string_view group);
/// The text of one time step: a vertex for each body, with the bodies' fields of one frame.
std::string xdmf_bodies(double time, std::int64_t bodies, std::string_view group);

}   // namespace cablenet::output
