#pragma once
#include <array>
#include <memory>
#include <string>

/// A function of time that the user wrote as a text.  Tests: tests/unit/motion_test.cpp
namespace cablenet::scene {

/// GiNaC differentiates the text once, when the object is made.  From then on muParser evaluates the function and its
/// first two derivatives as bytecode.
/// Limits: an evaluation writes the variable that the bytecode reads, so only one thread may use an object.
class Expression {
public:
  /// @throws InputError if `text` is no twice differentiable expression of t, and says why.
  explicit Expression(const std::string& text);
  ~Expression();
  Expression(Expression&&) noexcept;

  /// The value, the first and the second derivative at t [s].
  std::array<double, 3> at(double t) const;

private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}   // namespace cablenet::scene
