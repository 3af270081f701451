#include "cablenet/app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace cablenet::app {
namespace {

constexpr double terminal_period = 0.2;   // [s] of wall time
constexpr double plain_period = 5;

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

/// mpirun gives its ranks a terminal of their own, whatever its own output is.  So the output of mpirun is looked at,
/// which is the parent process.
bool output_is_terminal() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return isatty(STDOUT_FILENO) != 0;
  std::error_code problem;
  const std::string target = std::filesystem::read_symlink(fmt::format("/proc/{}/fd/1", getppid()), problem).string();
  return !problem && (target.starts_with("/dev/pts/") || target.starts_with("/dev/tty"));
}

std::string clock_time(double s) {
  const long whole = static_cast<long>(s + 0.5);
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}   // namespace

Progress::Progress(double start, double end) : start_(start), end_(end), terminal_(output_is_terminal()) {}

void Progress::step(double t, double dt, long steps, long newton) {
  const Clock::time_point now = Clock::now();
  if (seconds(now - shown_) < (terminal_ ? terminal_period : plain_period)) return;
  shown_ = now;
  print(t, dt, steps, newton);
}

void Progress::print(double t, double dt, long steps, long newton) {
  const double done = (t - start_) / (end_ - start_);
  const double left = done > 0 ? seconds(Clock::now() - begun_) * (1 - done) / done : 0;
  const std::string line =
      fmt::format("t = {:.6g} of {:.6g} s ({:.0f} %)  step {}  dt {:.3g} s  Newton {:.2f}/step  left {}", t, end_,
                  100 * done, steps, dt, static_cast<double>(newton) / static_cast<double>(steps), clock_time(left));
  std::fputs(terminal_ ? ("\r\033[K" + line).c_str() : (line + "\n").c_str(), stdout);
  std::fflush(stdout);
  line_open_ = terminal_;
}

void Progress::finish(double t, long steps, long newton) {
  if (line_open_) std::fputs("\r\033[K", stdout);
  const std::string line = fmt::format(
      "t = {:.6g} s reached in {} steps, {:.2f} Newton iterations a step, {:.3g} s of wall time\n", t, steps,
      steps > 0 ? static_cast<double>(newton) / static_cast<double>(steps) : 0.0, seconds(Clock::now() - begun_));
  std::fputs(line.c_str(), stdout);
  std::fflush(stdout);
}

}   // namespace cablenet::app
