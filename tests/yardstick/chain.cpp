#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// This program shows what one core can do at best without tricks.  A steel cable, straight and level at first, is
/// pinned at its first node and falls.  The program is written for this case alone and is independent of cablenet,
/// whose speed and result are compared with it.  The scheme is the energy-momentum one of
/// include/cablenet/elements/cable.hpp.
/// Newton's stopping rule is the one of src/solve/newton.cpp, so that both programs do the same number of iterations.
/// Nodes are 0 .. n, and node 0 is the pin.  Element i lies between nodes i - 1 and i.
namespace {

constexpr double gravity = 9.81, area = 1.962e-5, density = 7800, youngs_modulus = 53e9;
constexpr double axial_stiffness = youngs_modulus * area;
constexpr int most_iterations = 25;

struct Vector3 {
  double x, y, z;
};

Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector3 operator*(double s, Vector3 a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The entries stand column by column.
using Matrix3 = std::array<Vector3, 3>;

Vector3 operator*(const Matrix3& a, Vector3 b) { return b.x * a[0] + b.y * a[1] + b.z * a[2]; }

void add_to_diagonal(Matrix3& a, double s) {
  a[0].x += s;
  a[1].y += s;
  a[2].z += s;
}

/// LU factors without exchange of rows.  The pivot blocks do not need one: each is a mass plus a nearly symmetric
/// positive stiffness.
class Factored3 {
public:
  explicit Factored3(const Matrix3& a) : u01_(a[1].x), u02_(a[2].x) {
    inverse0_ = 1 / a[0].x;
    l10_ = a[0].y * inverse0_;
    l20_ = a[0].z * inverse0_;
    inverse1_ = 1 / (a[1].y - l10_ * u01_);
    l21_ = (a[1].z - l20_ * u01_) * inverse1_;
    u12_ = a[2].y - l10_ * u02_;
    inverse2_ = 1 / (a[2].z - l20_ * u02_ - l21_ * u12_);
  }

  Vector3 solve(Vector3 b) const {
    const double y = b.y - l10_ * b.x;
    const double z = (b.z - l20_ * b.x - l21_ * y) * inverse2_;
    const double middle = (y - u12_ * z) * inverse1_;
    return {(b.x - u01_ * middle - u02_ * z) * inverse0_, middle, z};
  }

private:
  double u01_, u02_, u12_, l10_, l20_, l21_, inverse0_, inverse1_, inverse2_;
};

/// An element's chords at the step's start and end, and its force over the sum of these chords.
struct Element {
  Vector3 d0, d1;
  double l0, l1;
  double force_density;
};

/// The row of a node after elimination: dx(i) = right - coupling dx(i - 1).
struct Row {
  Matrix3 coupling;
  Vector3 right;
};

class Chain {
public:
  Chain(std::size_t elements, double length, double step, double xi)
      : n_(elements),
        L_(length / static_cast<double>(elements)),
        dt_(step),
        xi_(xi),
        mass_(density * area * L_),
        x_(n_ + 1),
        x0_(n_ + 1),
        v_(n_ + 1),
        a_(n_ + 1),
        residual_(n_ + 1),
        elements_(n_ + 1),
        rows_(n_ + 1) {
    const double all = std::sqrt(static_cast<double>(n_));
    tolerance_ = 1e-12 * all * mass_ * gravity;
    noise_ = 2 * std::numeric_limits<double>::epsilon() * length * all *
             (2 * axial_stiffness / L_ + 4 / (dt_ * dt_) * mass_);
    for (std::size_t i = 1; i <= n_; ++i) {
      x_[i].x = length * static_cast<double>(i) / static_cast<double>(n_);
      elements_[i].d1 = x_[i] - x_[i - 1];
      elements_[i].l1 = std::sqrt(dot(elements_[i].d1, elements_[i].d1));
    }
    fill_first_acceleration();
  }

  void step() {
    predict();
    double norm = residual(), previous = 0;
    for (int iteration = 0; !converged(iteration, norm, previous); ++iteration) {
      if (iteration == most_iterations || !std::isfinite(norm)) throw std::runtime_error("Newton's method failed");
      eliminate();
      correct();
      previous = norm;
      norm = residual();
      ++iterations_;
    }
    for (std::size_t i = 1; i <= n_; ++i) {
      const Vector3 v1 = 2 / dt_ * (x_[i] - x0_[i]) - v_[i];
      a_[i] = 1 / dt_ * (v1 - v_[i]);
      v_[i] = v1;
    }
  }

  long iterations() const { return iterations_; }
  Vector3 tip() const { return x_[n_]; }

private:
  /// Solves M a = weight.  The unstretched level cable has no other force, so only z is in motion.
  void fill_first_acceleration() {
    const double sixth = mass_ / 6;
    std::vector<double> factor(n_ + 1);
    double pivot = 2 * sixth, load = -0.5 * mass_ * gravity;
    for (std::size_t i = n_; i >= 1; --i) {
      factor[i] = sixth / pivot;
      a_[i].z = load / pivot;
      load = -mass_ * gravity - sixth * a_[i].z;
      pivot = 4 * sixth - sixth * factor[i];
    }
    for (std::size_t i = 2; i <= n_; ++i) a_[i].z -= factor[i] * a_[i - 1].z;
  }

  void predict() {
    for (std::size_t i = 1; i <= n_; ++i) {
      elements_[i].d0 = elements_[i].d1;
      elements_[i].l0 = elements_[i].l1;
      x0_[i] = x_[i];
      x_[i] = x_[i] + dt_ * v_[i] + dt_ * dt_ / 2 * a_[i];
    }
  }

  /// The residual is twice the forces out of balance at mid-step, so that its norms compare with PETSc's.
  /// @return the 2-norm of the residual
  double residual() {
    const double third = mass_ / 3;
    const Vector3 half_weight{0, 0, mass_ * gravity};
    const Vector3 still{0, 0, 0};
    Vector3 q1 = still, before = still;
    double sum = 0;
    for (std::size_t i = 1; i <= n_; ++i) {
      Element& e = elements_[i];
      e.d1 = x_[i] - x_[i - 1];
      e.l1 = std::sqrt(dot(e.d1, e.d1));
      const double tension = axial_stiffness / L_ * ((0.5 - xi_) * (e.l0 - L_) + (0.5 + xi_) * (e.l1 - L_));
      e.force_density = tension / (e.l0 + e.l1);
      const Vector3 f = 2 * e.force_density * (e.d0 + e.d1);
      const Vector3 q2 = 2 / dt_ * (1 / dt_ * (x_[i] - x0_[i]) - v_[i]);
      const Vector3 left = before + third * (2 * q1 + q2) - f + half_weight;
      residual_[i - 1] = left;
      sum += i > 1 ? dot(left, left) : 0;
      before = third * (q1 + 2 * q2) + f + half_weight;
      q1 = q2;
    }
    residual_[n_] = before;
    return std::sqrt(sum + dot(before, before));
  }

  /// The derivative of the element's force, doubled as the residual is.  It is unsymmetric.
  Matrix3 stiffness(const Element& e) const {
    const double k = axial_stiffness / L_ * (0.5 + xi_);
    const Vector3 u = 2 * (k - e.force_density) / ((e.l0 + e.l1) * e.l1) * (e.d0 + e.d1);
    Matrix3 matrix{e.d1.x * u, e.d1.y * u, e.d1.z * u};
    add_to_diagonal(matrix, 2 * e.force_density);
    return matrix;
  }

  /// Block elimination from the free end to the pin, which includes the right side.  Tangents are not stored, because
  /// each is needed once.
  void eliminate() {
    const double inertia = mass_ / 6 * 4 / (dt_ * dt_);
    Matrix3 K = stiffness(elements_[n_]);
    Matrix3 pivot = K;
    add_to_diagonal(pivot, 2 * inertia);
    Vector3 right = residual_[n_];
    for (std::size_t i = n_; i >= 1; --i) {
      Matrix3 B{-1 * K[0], -1 * K[1], -1 * K[2]};
      add_to_diagonal(B, inertia);
      const Factored3 factored(pivot);
      Row& row = rows_[i];
      row.coupling = {factored.solve(B[0]), factored.solve(B[1]), factored.solve(B[2])};
      row.right = factored.solve(right);
      if (i == 1) break;
      const Matrix3 next = stiffness(elements_[i - 1]);
      for (std::size_t k = 0; k < 3; ++k) pivot[k] = K[k] + next[k] - B * row.coupling[k];
      add_to_diagonal(pivot, 4 * inertia);
      right = residual_[i - 1] - B * row.right;
      K = next;
    }
  }

  void correct() {
    Vector3 dx{0, 0, 0};
    for (std::size_t i = 1; i <= n_; ++i) {
      dx = rows_[i].right - rows_[i].coupling * dx;
      x_[i] = x_[i] - dx;
    }
  }

  bool converged(int iteration, double norm, double previous) {
    if (norm < tolerance_) return true;
    if (iteration == 0) return false;
    const double error = curvature_ * previous * previous;
    if (norm > noise_) curvature_ = norm / (previous * previous);
    const bool settled = norm <= 0.5 * noise_ && error <= 0.01 * noise_;
    const bool stuck = norm > 0.25 * previous && norm <= 8 * noise_;
    return settled || stuck;
  }

  std::size_t n_;
  double L_, dt_, xi_, mass_;
  double tolerance_ = 0, noise_ = 0, curvature_ = std::numeric_limits<double>::infinity();
  long iterations_ = 0;
  std::vector<Vector3> x_, x0_, v_, a_, residual_;
  std::vector<Element> elements_;
  std::vector<Row> rows_;
};

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void run(const std::vector<std::string>& words) {
  const std::size_t elements = std::stoul(words[0]);
  const long steps = std::stol(words[2]);
  const double xi = words.size() > 3 ? std::stod(words[3]) : 0;
  const double length = words.size() > 4 ? std::stod(words[4]) : 1.713;
  if (elements < 1 || steps < 1) throw std::invalid_argument("at least one element and one step");
  Chain chain(elements, length, std::stod(words[1]), xi);
  const double start = cpu_seconds();
  for (long i = 0; i < steps; ++i) chain.step();
  const double seconds = cpu_seconds() - start;
  const double unknown_iterations = 3 * static_cast<double>(elements) * static_cast<double>(chain.iterations());
  std::printf("elements=%zu steps=%ld newton=%ld cpu_seconds=%.6g us_per_step=%.6g ns_per_unknown_iteration=%.6g ",
              elements, steps, chain.iterations(), seconds, 1e6 * seconds / static_cast<double>(steps),
              1e9 * seconds / unknown_iterations);
  std::printf("tip=%.17g,%.17g\n", chain.tip().x, chain.tip().z);
}

void flush_denormals() {
#if defined(__SSE2__)
  _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}

}   // namespace

int main(int count, char** words) {
  if (count < 4 || count > 6) {
    std::fputs("usage: yardstick_chain ELEMENTS STEP STEPS [XI [LENGTH]]\n", stderr);
    return 2;
  }
  // cablenet does the same: numbers below 2e-308, which arise far from the pin, would be slow.
  flush_denormals();
  try {
    run({words + 1, words + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "yardstick_chain: %s\n", error.what());
    return 1;
  }
  return 0;
}
