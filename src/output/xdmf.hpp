#pragma once
#include <cstdint>
#include <string>
#include <string_view>

/// The XDMF 3 text by which ParaView finds the frames: only what its Xdmf2 and Xdmf3 readers both read.
namespace cablenet::output {

extern const std::string_view xdmf_head;
extern const std::string_view xdmf_tail;

/// One time step: the mesh of mesh.h5 with the fields of one frame.
/// @param group  the frame's data as FILE:/GROUP, FILE relative to the .xmf
std::string xdmf_step(double time, std::int64_t nodes, std::int64_t elements, std::string_view group);

}   // namespace cablenet::output
