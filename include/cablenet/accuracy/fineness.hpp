#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cablenet/scene/scene.hpp"

/// How fine a run is, and the scene of a run that is so fine.  Tests: tests/parallel/accuracy_test.cpp
namespace cablenet::accuracy {

/// The steps of a run.
struct Stepping {
  double step = 0;                        ///< the length of a step, or of the first adaptive one [s]
  std::optional<double> tolerance = {};   ///< of adaptive steps [m]; none: equal steps
};

struct Fineness {
  double elements = 0;   ///< of a cable whose weight is 1
  Stepping stepping = {};
};

/// How a cable bends in the course of a run.
struct Bending {
  double length;                   ///< unstretched [m]
  std::vector<double> curvature;   ///< in root mean squares over time, in equal parts of the cable [1/m]
};

/// How elements are shared out among the cables that have none in the scene, and along them.
class Mesh {
public:
  /// Cables get elements by the square root of their lengths, everywhere alike.
  explicit Mesh(const scene::Scene& scene);

  /// By the bends of a run.  Chords of the length h of a line that bends by kappa err by (kappa h)^2/24 of its length.
  /// The sum of that is least for a given number of elements where their density goes with kappa^(2/3).
  /// @param bends  of each of the scene's cables
  void grade(const std::vector<Bending>& bends);

  /// The length of the longest cable, or 1.  [m]
  double extent() const { return extent_; }
  /// No cable is left to be divided.
  bool is_given() const { return chosen_.empty(); }
  /// The numbers of elements, as [index into Scene::cables, number].
  std::vector<std::pair<std::size_t, int>> counts(double elements) const;
  /// What is really had of `elements`, as numbers are whole.
  double had(double elements) const;
  /// The scene with these elements.
  scene::Scene divided(const scene::Scene& scene, double elements) const;

private:
  struct Part {
    std::size_t cable;   ///< index into Scene::cables
    double length;       ///< [m]
    int least;           ///< elements
    double weight = 1;   ///< of all cables, the largest is 1
    std::vector<double> density = {};
  };
  std::vector<Part> chosen_;
  double extent_ = 0;
};

/// The interval of rows by which runs are compared: the scene's, or a part of it, so that there are at least 50.  [s]
double interval_of_rows(const scene::Scene& scene);

/// Whether the scene leaves sizes to be chosen.
bool is_open(const scene::Scene& scene);

/// The scene with half the elements of each cable and twice the step.
scene::Scene halved(const scene::Scene& scene);

/// The elements of a cable in the first coarse run.
constexpr double first_elements = 8;

/// Whether rows at this time are not only for comparing: the scene asks for them, or a run ends there.
/// @param interval  of rows for comparing [s]
bool is_written(const scene::Scene& scene, double interval, double t);

/// The scene with these sizes, where it leaves them to be chosen.
scene::Scene made(const scene::Scene& scene, const Mesh& mesh, const Fineness& fineness);

}   // namespace cablenet::accuracy
