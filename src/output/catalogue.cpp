#include "catalogue.hpp"

#include <utility>

#include "files.hpp"
#include "xdmf.hpp"

namespace cablenet::output {

Catalogue::Catalogue(std::filesystem::path directory, Origin origin, const Totals& totals)
    : directory_(std::move(directory)), origin_(std::move(origin)), totals_(totals) {}

void Catalogue::add_frame(double time) {
  const std::string group = segment_name(static_cast<int>(ends_.size())) + ":" + frame_name(frames_);
  cable_steps_ += xdmf_cables(time, totals_.nodes, totals_.elements, group);
  if (totals_.bodies > 0) body_steps_ += xdmf_bodies(time, totals_.bodies, group);
  ++frames_;
}

void Catalogue::close_segment() {
  ends_.push_back(frames_);
  // In this order every frame that an .xmf lists is in result.h5 too, even if the run is killed in between.
  write_result();
  write_xdmf();
}

void Catalogue::write_result() const {
  const auto path = directory_ / "result.h5";
  const auto temporary = directory_ / "result.h5.tmp";
  // HDF5's file access by MPI takes no lock, unlike its serial access.  Some file servers refuse locks.
  Hdf5File file(MPI_COMM_SELF, temporary);
  stamp(file, origin_);
  file.link("/mesh", "mesh.h5", "/mesh");
  file.create_group("/frames");
  std::int64_t frame = 0;
  for (std::size_t segment = 0; segment < ends_.size(); ++segment)
    for (const auto name = segment_name(static_cast<int>(segment)); frame < ends_[segment]; ++frame)
      file.link(frame_name(frame), name, frame_name(frame));
  file.close();
  publish(temporary, path);
}

void Catalogue::write_xdmf() const {
  // ParaView cannot show a mesh without cells.
  if (totals_.elements > 0) replace_text(directory_ / "cables.xmf", xdmf_head("cables"), cable_steps_, xdmf_tail);
  if (totals_.bodies > 0) replace_text(directory_ / "bodies.xmf", xdmf_head("bodies"), body_steps_, xdmf_tail);
}

}   // namespace cablenet::output
