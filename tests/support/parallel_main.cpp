#include <gtest/gtest.h>
#include <petsc.h>

#include <iostream>

/// A failure on one rank fails the test on every rank, and the failing rank is named.
class RankVerdicts : public testing::EmptyTestEventListener {
  void OnTestPartResult(const testing::TestPartResult& result) override {
    int rank = 0;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    if (result.failed() && rank != 0)
      std::cerr << "[rank " << rank << "] " << (result.file_name() ? result.file_name() : "?") << ":"
                << result.line_number() << ": " << result.message() << std::endl;
  }
  void OnTestEnd(const testing::TestInfo& info) override {
    int failed = info.result()->Failed() ? 1 : 0;
    int any = 0;
    MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
    if (any && !failed) ADD_FAILURE() << "failed on another rank: " << info.name();
  }
};

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (rank != 0) delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new RankVerdicts);
  const int verdict = RUN_ALL_TESTS();
  PetscFinalize();
  return verdict;
}
