#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cablenet/scene/scene.hpp"
#include "names.hpp"
#include "yaml_reader.hpp"

/// The scene on its way from the file to scene::Scene.  Each section is read by itself into drafts; then `repeat` is
/// expanded into copies, and names become indices.  Tests: tests/unit/read_test.cpp
namespace cablenet::scene {

/// What a cable's end says, before it is known what bears the name.
struct Reference {
  enum class Target { named, cable, net } target = Target::named;   ///< named: a point or BODY.ATTACHMENT
  std::string name;
  double at = 0;               ///< unstretched length from the start of the cable `name` [m]
  std::array<int, 2> node{};   ///< of the net `name`
  Value value;                 ///< the whole end, for messages
};

/// How a cable is repeated.
struct Repeat {
  int count = 0;
  double every = 0;                   ///< unstretched length of the tapped cable from one copy to the next [m]
  Vector3 offset = Vector3::Zero();   ///< of each copy to the one before [m]
  Value value;
};

/// A point or a body as it was read.  The `repeat` of a cable that ends there makes copies of it.
template <class T>
struct Draft {
  T thing;
  Value value;
  int copies = 0;                     ///< 0: not repeated
  Vector3 offset = Vector3::Zero();   ///< of each copy to the one before [m]
  std::string repeated_by = {};       ///< the name of the cable that repeats it
};
using PointDraft = Draft<Point>;
struct BodyDraft : Draft<Body> {
  std::vector<Value> attachments;   ///< one per attachment of the body
};

struct CableDraft {
  Cable cable;
  Reference from, to;
  std::optional<Repeat> repeat;
  Value value;
  int copies() const { return repeat ? repeat->count : 1; }
};

/// The forms of the sections at the top of the file.
Form environment_form();
Form cable_types_form();
Form points_form();
Form bodies_form();
Form cables_form();
Form nets_form();
Form time_form();
Form output_form();

/// Puts gravity, fluid and bed into the scene.
void read_environment(const Value&, Scene&);
Time read_time(const Value&, const Scene& scene);
/// @pre the scene's time is read, and whether it starts from an equilibrium.
Output read_output(const std::optional<Value>&, const Scene&, const SceneNames&);
/// @pre the scene's environment is read.
std::vector<CableType> read_cable_types(const Value&, const Scene&, Names& types);
std::vector<PointDraft> read_points(const Value&, const Time&);
std::vector<BodyDraft> read_bodies(const Value&);
std::vector<CableDraft> read_cables(const Value&, const Scene& scene, const Names& types);
std::vector<Net> read_nets(const Value&, const Names& types, Names& nets);

/// @throws InputError if the scene has more nodes than an unknown's number can count.
void check_size(const std::vector<CableDraft>&, const std::vector<Net>&, const Value& top);
/// Tells the points and bodies at the ends of repeated cables how often they are copied.
void mark_repeated(const std::vector<CableDraft>&, std::vector<PointDraft>&, std::vector<BodyDraft>&);
std::vector<Point> expand_points(const std::vector<PointDraft>&, Names& points);
std::vector<Body> expand_bodies(const std::vector<BodyDraft>&, Names& bodies);
/// @param nets  the section, where there is one
/// @throws InputError where lengths that are found by tensions cannot be: in a run from rest, and of a tapped cable.
/// @pre the scene's nets are read, and whether it starts from an equilibrium.
void check_pretensions(const std::vector<CableDraft>&, const std::optional<Value>& nets, const Scene&);
/// @throws InputError if taps go round in a circle.
void check_circles(const std::vector<CableDraft>&);
/// @pre `scene` holds all but its cables.
/// @throws InputError if a reference leads nowhere or past an end.
std::vector<Cable> expand_cables(const std::vector<CableDraft>&, const Scene&, SceneNames&);
/// Checks ends against each other.  @throws InputError if a cable has no length or a free point has no cable.
void check_ends(const std::vector<CableDraft>&, const std::vector<PointDraft>&, const Scene&);
/// Notes on what is allowed of water and of things in it, or in a vacuum, but hardly meant.
std::vector<std::string> water_notes(const Section& top, const std::vector<PointDraft>&, const std::vector<BodyDraft>&,
                                     const Scene&);
/// Adds notes on what is allowed of bodies but hardly meant.  @pre the scene is expanded.
void add_body_notes(const std::vector<BodyDraft>&, const std::vector<CableDraft>&, Scene&);
/// Adds notes on forces that depend on time where this does little.
void add_force_notes(const std::vector<PointDraft>&, Scene&);
/// Adds notes on what a scene without `time` makes no use of.
void add_static_notes(const std::vector<PointDraft>&, const std::vector<BodyDraft>&, const std::vector<CableDraft>&,
                      Scene&);

}   // namespace cablenet::scene
