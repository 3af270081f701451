#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cablenet/scene/scene.hpp"
#include "names.hpp"
#include "yaml_reader.hpp"

/// The scene between the file and scene::Scene: sections read one by one, names not yet resolved, repeats not yet
/// expanded.  Tests: tests/unit/read_test.cpp
namespace cablenet::scene {

/// What a cable's end says, before it is known what bears the name.
struct Reference {
  enum class Kind { named, cable, net } kind = Kind::named;   ///< named: a point, or body.attachment
  std::string name;
  double at = 0;               ///< along a cable [m]
  std::array<int, 2> node{};   ///< of a net
  Value value;                 ///< the whole reference
};

struct Repeat {
  int count = 0;
  double every = 0;                   ///< along the tapped cable [m]
  Vector3 offset = Vector3::Zero();   ///< of each copy to the one before [m]
  Value value;
};

/// A thing that cables end at and that the `repeat` of one of them copies.
template <class T>
struct Draft {
  T thing;
  Value value;
  int copies = 0;                     ///< 0: not repeated
  Vector3 offset = Vector3::Zero();   ///< of each copy to the one before [m]
  std::string repeated_by = {};       ///< the cable
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

/// What the values of the keys at the top may look like.
Form environment_form();
Form cable_types_form();
Form points_form();
Form bodies_form();
Form cables_form();
Form nets_form();
Form time_form();
Form output_form();

/// Gravity, fluid and bed of the scene.
void read_environment(const Value&, Scene&);
Time read_time(const Value&);
/// @pre the scene's time is read.
Output read_output(const std::optional<Value>&, const Time&, const SceneNames&);
/// @pre the scene's environment is read.
std::vector<CableType> read_cable_types(const Value&, const Scene&, Names& types);
std::vector<PointDraft> read_points(const Value&, const Time&);
std::vector<BodyDraft> read_bodies(const Value&);
std::vector<CableDraft> read_cables(const Value&, const Names& types);
std::vector<Net> read_nets(const Value&, const Names& types, Names& nets);

/// @throws InputError if the scene has more nodes than an unknown's number can count.
void check_size(const std::vector<CableDraft>&, const std::vector<Net>&, const Value& top);
/// Puts `repeat` of the cables on the points and bodies that they repeat.
void mark_repeated(const std::vector<CableDraft>&, std::vector<PointDraft>&, std::vector<BodyDraft>&);
std::vector<Point> expand_points(const std::vector<PointDraft>&, Names& points);
std::vector<Body> expand_bodies(const std::vector<BodyDraft>&, Names& bodies);
/// @throws InputError if taps go round in a circle.
void check_circles(const std::vector<CableDraft>&);
/// @pre `scene` holds all but its cables.
/// @throws InputError if a reference leads nowhere or past an end.
std::vector<Cable> expand_cables(const std::vector<CableDraft>&, const Scene&, SceneNames&);
/// What can be said only when all ends are known.
void check_ends(const std::vector<CableDraft>&, const std::vector<PointDraft>&, const Scene&);
/// What is allowed of water, and of things in it or out of it, but perhaps not meant.
std::vector<std::string> water_notes(const Section& top, const std::vector<PointDraft>&, const std::vector<BodyDraft>&,
                                     const Scene&);
/// To the scene's notes: what is allowed of bodies but perhaps not meant.  @pre the scene is expanded.
void add_body_notes(const std::vector<BodyDraft>&, const std::vector<CableDraft>&, Scene&);
/// To the scene's notes: what a scene without `time` makes no use of.
void add_static_notes(const std::vector<PointDraft>&, const std::vector<BodyDraft>&, const std::vector<CableDraft>&,
                      Scene&);

}   // namespace cablenet::scene
