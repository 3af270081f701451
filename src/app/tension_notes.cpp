#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cablenet/app/run_notes.hpp"

namespace cablenet::app {
namespace {

using system::ElementTension;

/// What is smaller than this part of the largest tension is not worth a note, and what strains a cable less is
/// rounding.
constexpr double significant_part = 1e-3, least_strain = 1e-9;

/// A peak that is so many times what lasted is one.
constexpr double peak_factor = 1.5;

/// The logarithm of the growth by which rounding, 1e-16 of a position, becomes a hundredth of it.
constexpr double folding_limit = 32;

/// Lines that push so little bend little.  Of errors that have grown so far the motion shows a sixth.
constexpr double least_bending = 5, most_bent = 0.2, good_bent = 0.05;

/// Two numbers that differ by less may be the same one, on another number of ranks.
constexpr double tie = 1e-6;

std::string force(double newtons) {
  if (newtons >= 1e6) return fmt::format("{:.3g} MN", 1e-6 * newtons);
  return newtons >= 1e3 ? fmt::format("{:.3g} kN", 1e-3 * newtons) : fmt::format("{:.3g} N", newtons);
}

/// Per cable and net, of all its elements on all ranks.
struct Extremes {
  explicit Extremes(std::size_t spans)
      : push(spans, 0), largest(spans, 0), held(spans, 0), folding(spans, 0), bending(spans, far) {}

  static constexpr double far = 1e30;
  std::vector<double> push, largest, held, folding;   ///< as in ElementTension; a push is positive
  std::vector<double> bending;                        ///< the least folding of any element: the whole line pushed
};

class TensionNotes {
public:
  TensionNotes(const network::Network& network, std::size_t cables, system::Assembler& assembler);

  std::vector<std::string> notes(double total_share) const;

private:
  using Measure = double (*)(const ElementTension&);
  struct Extreme {
    std::size_t span;
    int element;   ///< in its cable, from 1
    ElementTension tension;
  };

  std::size_t span_of(std::size_t own) const { return network_.span_at(scene_element_[own]); }
  /// The first of those with the largest value.
  static std::size_t worst(const std::vector<double>& values);
  /// The span's element where the measure reaches `value`, the largest in the span.  Collective.
  Extreme find(std::size_t span, Measure measure, double value) const;
  std::string name(std::size_t span) const;
  std::string place(const Extreme& extreme) const;

  bool pushes(std::size_t span) const;
  void add_push(std::vector<std::string>& notes) const;
  void add_folding(std::vector<std::string>& notes) const;
  void add_bending(std::vector<std::string>& notes, double total_share) const;
  void add_peak(std::vector<std::string>& notes) const;

  const network::Network& network_;
  const std::size_t cables_;   ///< The spans after them are nets.
  MPI_Comm communicator_;
  const std::vector<int>& scene_element_;
  std::span<const ElementTension> own_;
  Extremes extremes_;
  double largest_ = 0;   ///< of all, pushes included [N]
};

TensionNotes::TensionNotes(const network::Network& network, std::size_t cables, system::Assembler& assembler)
    : network_(network),
      cables_(cables),
      communicator_(assembler.communicator()),
      scene_element_(assembler.network().scene_element),
      own_(assembler.tensions()),
      extremes_(network.spans.size()) {
  for (std::size_t i = 0; i < own_.size(); ++i) {
    const std::size_t span = span_of(i);
    const auto raise = [&](std::vector<double>& values, double value) { values[span] = std::max(values[span], value); };
    raise(extremes_.push, -own_[i].least);
    raise(extremes_.largest, own_[i].largest);
    raise(extremes_.held, own_[i].held());
    raise(extremes_.folding, own_[i].most_folding);
    extremes_.bending[span] = std::min(extremes_.bending[span], own_[i].most_folding);
  }
  for (auto* values : {&extremes_.push, &extremes_.largest, &extremes_.held, &extremes_.folding})
    MPI_Allreduce(MPI_IN_PLACE, values->data(), static_cast<int>(values->size()), MPI_DOUBLE, MPI_MAX, communicator_);
  MPI_Allreduce(MPI_IN_PLACE, extremes_.bending.data(), static_cast<int>(extremes_.bending.size()), MPI_DOUBLE, MPI_MIN,
                communicator_);
  for (std::size_t span = 0; span < network.spans.size(); ++span)
    largest_ = std::max({largest_, extremes_.largest[span], extremes_.push[span]});
}

std::size_t TensionNotes::worst(const std::vector<double>& values) {
  const double largest = *std::max_element(values.begin(), values.end());
  const auto is_it = [&](double value) { return value >= (1 - tie) * largest; };
  return static_cast<std::size_t>(std::find_if(values.begin(), values.end(), is_it) - values.begin());
}

TensionNotes::Extreme TensionNotes::find(std::size_t span, Measure measure, double value) const {
  struct {
    int element, rank;
  } first{std::numeric_limits<int>::max(), 0};
  MPI_Comm_rank(communicator_, &first.rank);
  ElementTension found;
  for (std::size_t i = 0; i < own_.size(); ++i)
    if (span_of(i) == span && measure(own_[i]) >= (1 - tie) * value && scene_element_[i] < first.element) {
      first.element = scene_element_[i];
      found = own_[i];
    }
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_2INT, MPI_MINLOC, communicator_);
  MPI_Bcast(&found, sizeof found, MPI_BYTE, first.rank, communicator_);
  return {span, first.element - network_.spans[span].first_element + 1, found};
}

std::string TensionNotes::name(std::size_t span) const {
  return fmt::format("{} {}", span < cables_ ? "cable" : "net", network_.spans[span].name);
}

std::string TensionNotes::place(const Extreme& extreme) const {
  const int elements = network_.spans[extreme.span].elements;
  return elements == 1 ? "" : fmt::format(" in its element {} of {}", extreme.element, elements);
}

bool TensionNotes::pushes(std::size_t span) const {
  const auto first = at(network_.spans[span].first_element);
  const double stiffness = network_.materials[at(network_.elements[first].material)].axial_stiffness;
  return extremes_.push[span] > std::max(significant_part * largest_, least_strain * stiffness);
}

void TensionNotes::add_push(std::vector<std::string>& notes) const {
  std::vector<double> pushes(network_.spans.size(), 0);
  long count = 0;
  for (std::size_t span = 0; span < pushes.size(); ++span)
    if (this->pushes(span)) {
      pushes[span] = extremes_.push[span];
      ++count;
    }
  if (count == 0) return;
  const std::size_t span = worst(pushes);
  const Extreme most = find(
      span, [](const ElementTension& e) { return -e.least; }, pushes[span]);
  const std::string who = count == 1 ? fmt::format("{} pushed", name(span))
                                     : fmt::format("{} of {} {} pushed, {} the most", count, pushes.size(),
                                                   pushes.size() > cables_ ? "cables and nets" : "cables", name(span));
  notes.push_back(
      fmt::format("{}: {} at t = {:.4g} s{}, {:.2g} % of the run's largest tension, for {:.2g} s in all; "
                  "ropes do not push: tension_only: true",
                  who, force(pushes[span]), most.tension.least_at, place(most), 100 * pushes[span] / largest_,
                  most.tension.pushed));
}

void TensionNotes::add_folding(std::vector<std::string>& notes) const {
  std::vector<double> folding(network_.spans.size(), 0);
  for (std::size_t span = 0; span < folding.size(); ++span)
    if (pushes(span) && network_.spans[span].elements > 1) folding[span] = extremes_.folding[span];
  const std::size_t span = worst(folding);
  if (folding[span] < folding_limit) return;
  const Extreme most = find(
      span, [](const ElementTension& e) { return e.most_folding; }, folding[span]);
  notes.push_back(fmt::format(
      "{} pushed so hard and so long{} that a disturbance of it grows 1e{:.0f} times: it folds, and steps do not "
      "resolve how, so that other steps and other rank counts give other results; draw it as long as it is, or with "
      "shape: catenary, or give its type tension_only: true",
      name(span), place(most), std::floor(folding[span] / std::log(10.0))));
}

/// A line bends out where all its elements are pushed.  Its bends grow, and the errors of the steps grow with them.
void TensionNotes::add_bending(std::vector<std::string>& notes, double total_share) const {
  std::vector<double> bending(cables_, 0);
  for (std::size_t span = 0; span < cables_; ++span)
    if (pushes(span) && network_.spans[span].elements > 1) bending[span] = extremes_.bending[span];
  if (bending.empty()) return;
  const std::size_t span = worst(bending);
  const double growth = std::exp(bending[span]), bent = growth * total_share;
  if (bending[span] < least_bending || bending[span] >= folding_limit || bent <= most_bent) return;
  notes.push_back(fmt::format(
      "{} pushed in all its elements, so that it bends, and that makes errors grow {:.1g} times: the steps do not "
      "resolve this motion, and lead it astray by {} of its way; try steps or a tolerance that are {:.1g} times as "
      "long",
      name(span), growth, bent > 1 ? "all" : fmt::format("some {:.2g} %", 100 * bent), std::sqrt(good_bent / bent)));
}

void TensionNotes::add_peak(std::vector<std::string>& notes) const {
  const std::size_t span = worst(extremes_.largest);
  const double peak = extremes_.largest[span], held = extremes_.held[span];
  if (peak <= peak_factor * held) return;
  const Extreme most = find(
      span, [](const ElementTension& e) { return e.largest; }, peak);
  const std::string longer =
      held > significant_part * peak ? force(held) + " is the largest that lasted longer" : "none lasted longer";
  notes.push_back(
      fmt::format("the largest tension of {}, {} at t = {:.4g} s{}, lasted one step: it depends on the step; {}",
                  name(span), force(peak), most.tension.largest_at, place(most), longer));
}

std::vector<std::string> TensionNotes::notes(double total_share) const {
  std::vector<std::string> notes;
  add_push(notes);
  add_folding(notes);
  add_bending(notes, total_share);
  add_peak(notes);
  return notes;
}

}   // namespace

std::vector<std::string> tension_notes(const scene::Scene& scene, const network::Network& network,
                                       system::Assembler& assembler, double total_share) {
  if (network.elements.empty()) return {};
  return TensionNotes(network, scene.cables.size(), assembler).notes(total_share);
}

}   // namespace cablenet::app
