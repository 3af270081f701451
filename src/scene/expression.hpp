#pragma once
#include <array>
#include <memory>
#include <string>

/// A function of time given as text, with its first two derivatives.  Tests: tests/unit/motion_test.cpp
namespace cablenet::scene {

/// Differentiated symbolically by GiNaC once, evaluated as muParser bytecode from then on.
/// Limits: evaluation writes the variable that the bytecode reads, so one object belongs to one thread.
class Expression {
public:
  /// @throws InputError if `text` is no twice differentiable expression of t, naming the text and what is allowed.
  explicit Expression(const std::string& text);
  ~Expression();
  Expression(Expression&&) noexcept;

  /// Value, first and second derivative.
  std::array<double, 3> at(double t) const;

private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}   // namespace cablenet::scene
