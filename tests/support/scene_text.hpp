#pragma once
#include <sstream>
#include <string>
#include <type_traits>

#include "cablenet/scene/scene.hpp"

/// Every number, name and choice of a scene as text: two scenes are the same where their texts are.
namespace cablenet::test {

class SceneText {
public:
  explicit SceneText(const scene::Scene& scene) {
    text_.precision(17);
    add(scene.accuracy);
    add(scene.title, scene.gravity, scene.is_static, scene.starts_static);
    if (scene.fluid) add(*scene.fluid);
    if (scene.bed) add(*scene.bed);
    for (const scene::CableType& type : scene.cable_types) add(type);
    for (const scene::Point& point : scene.points) add(point, scene.time);
    for (const scene::Body& body : scene.bodies) add(body);
    for (const scene::Cable& cable : scene.cables) add(cable);
    for (const scene::Net& net : scene.nets) add(net);
    const scene::Time& time = scene.time;
    add(time.start, time.end, time.step, time.scheme, time.spectral_radius, time.axial_dissipation, time.tolerance);
    add(scene.output.interval, scene.output.energy, scene.output.history.size());
    for (const auto* list : {&scene.output.history, &scene.output.stiffness})
      for (const scene::HistoryItem& item : *list) add(item.kind, item.index);
  }

  std::string text() const { return text_.str(); }

private:
  template <class... T>
  void add(const T&... values) {
    (one(values), ...);
    text_ << '\n';
  }

  template <class T>
  void one(const T& value) {
    if constexpr (std::is_enum_v<T>)
      text_ << static_cast<int>(value) << ' ';
    else
      text_ << value << ' ';
  }
  template <class T>
  void one(const std::optional<T>& value) {
    value ? one(*value) : one("none");
  }
  template <class T, std::size_t n>
  void one(const std::array<T, n>& values) {
    for (const T& value : values) one(value);
  }
  template <class T>
  void one(const std::vector<T>& values) {
    for (const T& value : values) one(value);
  }
  void one(const Vector3& v) { text_ << v.transpose() << ' '; }
  void one(const Matrix3& m) { text_ << m.reshaped().transpose() << ' '; }
  void one(const scene::PointEnd& end) { text_ << "point " << end.point << ' '; }
  void one(const scene::TapEnd& end) { text_ << "tap " << end.cable << ' ' << end.at << ' '; }
  void one(const scene::NetEnd& end) { text_ << "net " << end.net << ' ' << end.node[0] << ' ' << end.node[1] << ' '; }
  void one(const scene::BodyEnd& end) { text_ << "body " << end.body << ' ' << end.attachment << ' '; }
  void one(const scene::CableEnd& end) {
    std::visit([this](const auto& at) { one(at); }, end);
  }

  void add(const environment::Fluid& fluid) {
    add(fluid.density, fluid.surface, fluid.depth);
    for (const environment::CurrentLayer& layer : fluid.current) add(layer.z, layer.velocity);
    for (const environment::Wave& wave : fluid.waves)
      add(wave.amplitude, wave.frequency, wave.number, wave.direction.x(), wave.direction.y(), wave.phase);
  }
  void add(const environment::Bed& bed) {
    add(bed.level, bed.stiffness, bed.damping, bed.friction, bed.friction_stiffness, bed.friction_velocity);
  }
  void add(const scene::CableType& type) {
    add(type.name, type.mass_per_length, type.axial_stiffness, type.tension_only, type.axial_damping);
    add(type.rayleigh_mass, type.rayleigh_stiffness, type.area, type.diameter);
    add(type.normal_drag, type.tangential_drag, type.added_mass);
  }
  void add(const scene::Point& point, const scene::Time& time) {
    add(point.name, point.position, point.velocity, point.mass, point.force);
    add(point.volume, point.drag_area, point.added_mass, point.contact_radius);
    for (const double share : {0.0, 0.3, 0.8})
      if (point.force_law) add(point.force_law->at(time.start + share * (time.end - time.start)));
    if (!point.motion) return;
    for (const double share : {0.0, 0.3, 0.8}) {
      const scene::Kinematics k = point.motion->at(time.start + share * (time.end - time.start));
      add(k.x, k.v, k.a);
    }
  }
  void add(const scene::Body& body) {
    add(body.name, body.mass, body.inertia, body.position, body.attitude.toRotationMatrix().eval(), body.velocity);
    add(body.angular_velocity, body.force, body.torque, body.rotation, body.volume, body.center_of_buoyancy);
    add(body.linear_drag, body.quadratic_drag, body.added_mass);
    if (body.contact) add(*body.contact);
    if (body.link) add(static_cast<int>(body.link->kind), body.link->axial_stiffness);
    for (const scene::Attachment& attachment : body.attachments) add(attachment.name, attachment.offset);
  }
  void add(const scene::Cable& cable) {
    add(cable.name, cable.type, cable.from, cable.to, cable.length, cable.tension, cable.elements, cable.shape);
    add(cable.polyline, cable.node_velocity);
  }
  void add(const scene::Net& net) {
    add(net.name, net.type, net.corners, net.meshes, net.slack, net.prestress, net.fixed);
  }

  std::ostringstream text_;
};

}   // namespace cablenet::test
