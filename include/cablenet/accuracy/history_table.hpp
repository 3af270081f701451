#pragma once
#include <string>
#include <vector>

/// The history of a run, and how far two of them differ.  Tests: tests/parallel/accuracy_test.cpp
namespace cablenet::accuracy {

/// Rows of the columns that output::Probes names; the first one is the time.
struct HistoryTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

/// What the error of each column is divided by.
/// It is the column's range.  A component of a vector is scaled by a tenth of the largest range of its components at
/// least, what hardly changes by a thousandth of its size.  In an equilibrium forces are scaled by their size, and
/// positions by the extent of all of them.  It is 0 for the time, for accelerations, which are means over a step, and
/// for what does not change.
std::vector<double> scales(const HistoryTable& table);

/// How far two histories differ: for each column the root mean square of the difference over time, divided by the
/// column's scale.
/// @param coarse  its rows are taken linearly between those of its times that `fine` does not have
/// @param fine    whose range scales
/// @pre both have the same columns
std::vector<double> differences(const HistoryTable& coarse, const HistoryTable& fine);

/// What a run errs by in its first part at least, per column: the root mean square over the whole run, as if it erred
/// nowhere else.  The run that it is held against has half its sizes, so that it errs by a quarter.
/// @param finer  a run that ends earlier
std::vector<double> errors_at_first(const HistoryTable& run, const HistoryTable& finer);

struct Estimate {
  double error = 0;       ///< infinite where the run could not be compared with another one
  std::string quantity;   ///< the worst one
};

/// The largest of the columns' errors, and the column that has it.  If all are zero, the result is infinite: nothing in
/// the history depends on the sizes, so that nothing is known of the error.
Estimate largest(const std::vector<double>& errors, const HistoryTable& table);

}   // namespace cablenet::accuracy
