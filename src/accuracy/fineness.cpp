#include "cablenet/accuracy/fineness.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "shortest_period.hpp"

namespace cablenet::accuracy {
namespace {

/// A cable has at least so many, for it has to bend in the middle.
constexpr int least_elements = 2;
/// Where a cable hardly bends it still has this part of the density of where it bends most.
constexpr double least_density = 0.5;
/// A cable that hardly bends has this part of the density of the one that bends most.
constexpr double least_share = 0.01;
constexpr double least_rows = 50, rows_in_period = 12;

Vector3 place_of(const scene::CableEnd& end, const scene::Scene& scene) {
  if (const auto* at = std::get_if<scene::PointEnd>(&end)) {
    const scene::Point& point = scene.points[static_cast<std::size_t>(at->point)];
    return point.motion ? point.motion->at(scene.time.start).x : point.position;
  }
  if (const auto* at = std::get_if<scene::BodyEnd>(&end)) {
    const scene::Body& body = scene.bodies[static_cast<std::size_t>(at->body)];
    return body.position + body.attitude * body.attachments[static_cast<std::size_t>(at->attachment)].offset;
  }
  return Vector3::Constant(std::nan(""));
}

/// The unstretched length, as far as it is known before cables are laid; 0 where it is not.
double length_of(const scene::Cable& cable, const scene::Scene& scene) {
  if (cable.length) return *cable.length;
  double drawn = 0;
  for (std::size_t i = 1; i < cable.polyline.size(); ++i) drawn += (cable.polyline[i] - cable.polyline[i - 1]).norm();
  if (drawn > 0) return drawn;
  const double chord = (place_of(cable.from, scene) - place_of(cable.to, scene)).norm();
  return std::isfinite(chord) ? chord : 0;
}

int taps_of(const scene::Scene& scene, std::size_t cable) {
  std::set<double> places;
  for (const scene::Cable& other : scene.cables)
    for (const auto& end : {other.from, other.to})
      if (const auto* tap = std::get_if<scene::TapEnd>(&end))
        if (tap->cable == static_cast<int>(cable)) places.insert(tap->at);
  return static_cast<int>(places.size());
}

}   // namespace

Mesh::Mesh(const scene::Scene& scene) {
  double longest = 0;
  for (std::size_t i = 0; i < scene.cables.size(); ++i) {
    const double length = length_of(scene.cables[i], scene);
    extent_ = std::max(extent_, length);
    if (scene.cables[i].elements > 0) continue;
    longest = std::max(longest, length);
    chosen_.push_back({i, length, std::max(least_elements, taps_of(scene, i) + 1)});
  }
  if (extent_ == 0) extent_ = 1;
  for (Part& part : chosen_) part.weight = part.length > 0 ? std::sqrt(part.length / longest) : 1;
}

void Mesh::grade(const std::vector<Bending>& bends) {
  double most = 0;
  for (const Part& part : chosen_)
    for (const double curvature : bends[part.cable].curvature) most = std::max(most, std::pow(curvature, 2.0 / 3));
  if (most == 0) return;
  double heaviest = 0;
  for (Part& part : chosen_) {
    const Bending& bending = bends[part.cable];
    part.density.clear();
    for (const double curvature : bending.curvature) part.density.push_back(std::pow(curvature, 2.0 / 3));
    const double floor = least_density * *std::max_element(part.density.begin(), part.density.end());
    part.weight = 0;
    for (double& value : part.density) {
      value = std::max({value, floor, least_share * most});
      part.weight += value * bending.length / static_cast<double>(part.density.size());
    }
    heaviest = std::max(heaviest, part.weight);
  }
  for (Part& part : chosen_) part.weight /= heaviest;
}

std::vector<std::pair<std::size_t, int>> Mesh::counts(double elements) const {
  std::vector<std::pair<std::size_t, int>> all;
  for (const Part& part : chosen_)
    all.emplace_back(part.cable, std::max(part.least, static_cast<int>(std::lround(part.weight * elements))));
  return all;
}

double Mesh::had(double elements) const {
  double numbers = 0, weights = 0;
  for (const auto& [cable, number] : counts(elements)) numbers += number;
  for (const Part& part : chosen_) weights += part.weight;
  return weights > 0 ? numbers / weights : elements;
}

scene::Scene Mesh::divided(const scene::Scene& scene, double elements) const {
  scene::Scene result = scene;
  for (const auto& [cable, number] : counts(elements)) {
    result.cables[cable].elements = number;
    result.cables[cable].has_chosen_mesh = true;
  }
  for (const Part& part : chosen_) result.cables[part.cable].density = part.density;
  return result;
}

double interval_of_rows(const scene::Scene& scene) {
  const double most =
      std::min((scene.time.end - scene.time.start) / least_rows, shortest_period(scene) / rows_in_period);
  if (scene.output.interval <= 0) return most;
  return scene.output.interval / std::max(1.0, std::ceil(scene.output.interval / most * (1 - 1e-9)));
}

bool is_open(const scene::Scene& scene) {
  const auto has_none = [](const scene::Cable& cable) { return cable.elements == 0; };
  return (!scene.is_static && scene.time.step == 0) || std::any_of(scene.cables.begin(), scene.cables.end(), has_none);
}

scene::Scene halved(const scene::Scene& scene) {
  scene::Scene result = scene;
  for (std::size_t i = 0; i < result.cables.size(); ++i) {
    int& elements = result.cables[i].elements;
    elements = std::min(elements, std::max(taps_of(scene, i) + 1, (elements + 1) / 2));
    result.cables[i].has_chosen_mesh = true;
  }
  result.time.step *= 2;
  if (result.time.tolerance) *result.time.tolerance *= 8;
  result.output.interval = interval_of_rows(scene);
  return result;
}

bool is_written(const scene::Scene& scene, double interval, double t) {
  const double since = t - scene.time.start;
  const auto is_multiple_of = [since](double span, double rounding) {
    return std::abs(since - std::round(since / span) * span) <= rounding;
  };
  const double rounding = 1e-6 * interval;
  return scene.is_static || scene.output.interval <= 0 || is_multiple_of(scene.output.interval, rounding) ||
         !is_multiple_of(interval, rounding) || t >= scene.time.end - rounding;
}

scene::Scene made(const scene::Scene& scene, const Mesh& mesh, const Fineness& fineness) {
  scene::Scene result = mesh.divided(scene, fineness.elements);
  if (scene.is_static || scene.time.step > 0) return result;
  result.time.step = fineness.stepping.step;
  if (!scene.time.tolerance) result.time.tolerance = fineness.stepping.tolerance;
  return result;
}

}   // namespace cablenet::accuracy
