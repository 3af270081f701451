#include "cablenet/output/history.hpp"

#include <gtest/gtest.h>
#include <mpi.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "cablenet/base/errors.hpp"

namespace fs = std::filesystem;
using cablenet::output::History;

namespace {

const std::vector<std::string> columns{"time", "free.x"};

/// Every rank has a file of its own, which is removed at the end.
class HistoryTest : public testing::Test {
protected:
  void TearDown() override { fs::remove(path_); }
  std::string text() const {
    std::ifstream in(path_);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path path_ = fs::temp_directory_path() / ("cablenet_history_" + std::to_string(getpid()) + ".csv");
};

}   // namespace

TEST_F(HistoryTest, RowsAreInTheFileAtOnceAndExact) {
  const std::vector<double> row{1.0 / 3, -std::numeric_limits<double>::denorm_min()};
  std::ofstream(path_) << "old,run\n1,2\n3,4\n";
  History history(path_, columns);
  EXPECT_EQ(text(), "time,free.x\n");
  history.write(row);
  history.write(std::vector{0.1, 2e6});
  EXPECT_EQ(text(), "time,free.x\n0.33333333333333331,-4.9406564584124654e-324\n0.10000000000000001,2000000\n");
}

TEST_F(HistoryTest, ARowOfAnotherLengthIsRefused) {
  History history(path_, columns);
  EXPECT_THROW(history.write(std::vector{1.0}), std::logic_error);
}

TEST_F(HistoryTest, NoFileNoHistory) { EXPECT_THROW(History("/dev/null/history.csv", columns), cablenet::OutputError); }

TEST_F(HistoryTest, AFullDiskIsAnError) {
  try {
    const History history("/dev/full", columns);
    ADD_FAILURE() << "no error";
  } catch (const cablenet::OutputError& error) {
    EXPECT_STREQ(error.what(), "cannot write /dev/full: No space left on device");
  }
}

TEST_F(HistoryTest, ARowThatDoesNotFitLeavesTheRowsBefore) {
  History history(path_, columns);
  history.write(std::vector{1.0, 2.0});
  rlimit usual{};
  getrlimit(RLIMIT_FSIZE, &usual);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tight{text().size() + 2, usual.rlim_max};
  setrlimit(RLIMIT_FSIZE, &tight);
  EXPECT_THROW(history.write(std::vector{3.0, 4.0}), cablenet::OutputError);
  setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(text(), "time,free.x\n1,2\n");
}
