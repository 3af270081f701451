#include "cablenet/scene/motion.hpp"

#include <gsl/gsl_interp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "expression.hpp"

namespace cablenet::scene {

struct Motion::Law {
  Law() = default;
  Law(const Law&) = delete;
  Law& operator=(const Law&) = delete;
  virtual ~Law() = default;
  virtual Kinematics at(double t) const = 0;
  virtual double first_time() const { return -std::numeric_limits<double>::infinity(); }
  virtual double last_time() const { return std::numeric_limits<double>::infinity(); }
};

namespace {

class Uniform : public Motion::Law {
public:
  Uniform(const Vector3& position, const Vector3& velocity, double t0) : p_(position), v_(velocity), t0_(t0) {}
  Kinematics at(double t) const override { return {p_ + v_ * (t - t0_), v_, Vector3::Zero()}; }

private:
  Vector3 p_, v_;
  double t0_;
};

class Harmonic : public Motion::Law {
public:
  Harmonic(const Vector3& position, const Vector3& amplitude, double period, double phase)
      : p_(position), amplitude_(amplitude), omega_(2 * std::numbers::pi / period), phase_(phase) {}
  Kinematics at(double t) const override {
    const double s = std::sin(omega_ * t + phase_);
    const double c = std::cos(omega_ * t + phase_);
    return {p_ + amplitude_ * s, amplitude_ * (omega_ * c), amplitude_ * (-omega_ * omega_ * s)};
  }

private:
  Vector3 p_, amplitude_;
  double omega_, phase_;
};

class Waypoints : public Motion::Law {
public:
  Waypoints(const std::vector<double>& times, const std::vector<Vector3>& positions) : times_(times) {
    const auto* kind = times.size() > 2 ? gsl_interp_cspline : gsl_interp_linear;
    for (int i = 0; i < 3; ++i) {
      auto& values = values_[static_cast<std::size_t>(i)];
      for (const Vector3& position : positions) values.push_back(position[i]);
      auto& spline = splines_[static_cast<std::size_t>(i)];
      spline.reset(gsl_interp_alloc(kind, times_.size()));
      gsl_interp_init(spline.get(), times_.data(), values.data(), times_.size());
    }
  }

  Kinematics at(double t) const override {
    // A step's end may miss the last waypoint by a rounding error, where GSL would give up.
    const double inside = std::clamp(t, times_.front(), times_.back());
    Kinematics k;
    for (int i = 0; i < 3; ++i) {
      const auto* spline = splines_[static_cast<std::size_t>(i)].get();
      const double* values = values_[static_cast<std::size_t>(i)].data();
      gsl_interp_eval_e(spline, times_.data(), values, inside, nullptr, &k.x[i]);
      gsl_interp_eval_deriv_e(spline, times_.data(), values, inside, nullptr, &k.v[i]);
      gsl_interp_eval_deriv2_e(spline, times_.data(), values, inside, nullptr, &k.a[i]);
    }
    return k;
  }

  double first_time() const override { return times_.front(); }
  double last_time() const override { return times_.back(); }

private:
  struct Free {
    void operator()(gsl_interp* spline) const { gsl_interp_free(spline); }
  };
  std::vector<double> times_;
  std::array<std::vector<double>, 3> values_;
  std::array<std::unique_ptr<gsl_interp, Free>, 3> splines_;
};

class Written : public Motion::Law {
public:
  Written(const Vector3& position, const std::array<std::string, 3>& texts)
      : p_(position), components_{Expression(texts[0]), Expression(texts[1]), Expression(texts[2])} {}
  Kinematics at(double t) const override {
    Kinematics k;
    for (int i = 0; i < 3; ++i) {
      const auto [x, v, a] = components_[static_cast<std::size_t>(i)].at(t);
      k.x[i] = p_[i] + x;
      k.v[i] = v;
      k.a[i] = a;
    }
    return k;
  }

private:
  Vector3 p_;
  std::array<Expression, 3> components_;
};

class Shifted : public Motion::Law {
public:
  Shifted(std::shared_ptr<const Motion::Law> law, const Vector3& offset) : law_(std::move(law)), offset_(offset) {}
  Kinematics at(double t) const override {
    Kinematics k = law_->at(t);
    k.x += offset_;
    return k;
  }
  double first_time() const override { return law_->first_time(); }
  double last_time() const override { return law_->last_time(); }

private:
  std::shared_ptr<const Motion::Law> law_;
  Vector3 offset_;
};

}   // namespace

Motion Motion::fixed(const Vector3& position) { return uniform(position, Vector3::Zero(), 0); }

Motion Motion::uniform(const Vector3& position, const Vector3& velocity, double t0) {
  return Motion(std::make_shared<Uniform>(position, velocity, t0));
}

Motion Motion::harmonic(const Vector3& position, const Vector3& amplitude, double period, double phase) {
  return Motion(std::make_shared<Harmonic>(position, amplitude, period, phase));
}

Motion Motion::waypoints(const std::vector<double>& times, const std::vector<Vector3>& positions) {
  return Motion(std::make_shared<Waypoints>(times, positions));
}

Motion Motion::expression(const Vector3& position, const std::array<std::string, 3>& texts) {
  return Motion(std::make_shared<Written>(position, texts));
}

Motion Motion::shifted(const Vector3& offset) const { return Motion(std::make_shared<Shifted>(law_, offset)); }

Kinematics Motion::at(double t) const { return law_->at(t); }
double Motion::first_time() const { return law_->first_time(); }
double Motion::last_time() const { return law_->last_time(); }

}   // namespace cablenet::scene
