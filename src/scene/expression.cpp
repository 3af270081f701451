#include "expression.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ginac/ginac.h>
#include <muParser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <locale>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "cablenet/base/errors.hpp"

namespace cablenet::scene {

struct Expression::Compiled {
  double t = 0;
  mu::Parser parser;
};

namespace {

using GiNaC::ex;

constexpr std::size_t longest_text = 20000;
constexpr int deepest_nesting = 100;

struct Function {
  const char* name;
  double (*evaluate)(double);
};

double unit_step(double x) { return x > 0 ? 1.0 : (x < 0 ? 0.0 : 0.5); }
double power(double base, double exponent) { return std::pow(base, exponent); }

constexpr Function functions[] = {
    {"sin", [](double x) { return std::sin(x); }},
    {"cos", [](double x) { return std::cos(x); }},
    {"tan", [](double x) { return std::tan(x); }},
    {"asin", [](double x) { return std::asin(x); }},
    {"acos", [](double x) { return std::acos(x); }},
    {"atan", [](double x) { return std::atan(x); }},
    {"sinh", [](double x) { return std::sinh(x); }},
    {"cosh", [](double x) { return std::cosh(x); }},
    {"tanh", [](double x) { return std::tanh(x); }},
    {"exp", [](double x) { return std::exp(x); }},
    {"log", [](double x) { return std::log(x); }},
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"step", unit_step},
};

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  const std::string shown = text.size() > 80 ? text.substr(0, 77) + "..." : text;
  throw InputError(fmt::format(
      "\"{}\" is not allowed: {}; expected an expression of t (time, s) and pi with numbers, + - * / ^ ( ) and sin cos "
      "tan asin acos atan sinh cosh tanh exp log sqrt step. Rewrite it with these.",
      shown, reason));
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_function(std::string_view name) {
  return std::any_of(std::begin(functions), std::end(functions), [&](const Function& f) { return name == f.name; });
}

void check_name(const std::string& text, std::string_view name, bool is_called) {
  if (name == "abs" || name == "sign" || name == "floor" || name == "min" || name == "max")
    refuse(text, fmt::format("{} has kinks or jumps, so the point would have no acceleration", name));
  const bool is_variable = name == "t" || name == "pi";
  if (!is_variable && !is_function(name)) refuse(text, fmt::format("{} is not known", name));
  if (is_variable && is_called) refuse(text, fmt::format("{} is no function; a product is written with *", name));
  if (!is_variable && !is_called) refuse(text, fmt::format("{} needs its argument in parentheses", name));
}

/// The length of the number at `begin`, 0 if there is none.
std::size_t number_length(const std::string& text, std::size_t begin) {
  double ignored = 0;
  const char* first = text.data() + begin;
  const auto result = std::from_chars(first, text.data() + text.size(), ignored);
  return static_cast<std::size_t>(result.ptr - first);
}

/// Finds a^b^c.  GiNaC 1.8.6 refuses it, 1.8.8 reads a^(b^c), other programs (a^b)^c; here it is always refused.
class PowerChain {
public:
  /// @return whether c is the second power in a row
  bool follows(char c) {
    if (c == '(') after_power_.push_back(false);
    if (c == ')' && after_power_.size() > 1) after_power_.pop_back();
    const bool again = c == '^' && after_power_.back();
    // A sign after ^ belongs to the exponent.
    if (c == '^' || (!is_exponents_start_ && std::string_view("+-*/").find(c) != std::string_view::npos))
      after_power_.back() = c == '^';
    if (c != ' ' && c != '\t' && c != '\n') is_exponents_start_ = c == '^';
    return again;
  }

private:
  std::vector<bool> after_power_{false};   ///< per open parenthesis: the last operator is a power
  bool is_exponents_start_ = false;
};

/// GiNaC's own parser also takes imaginary units, lists, comparisons and more, so names and signs are sifted before.
void check_tokens(const std::string& text) {
  if (text.find_first_not_of(" \t\n") == std::string::npos) refuse(text, "it is empty");
  if (text.size() > longest_text) refuse(text, fmt::format("it is longer than {} characters", longest_text));
  int depth = 0;
  PowerChain powers;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    if (is_letter(text[i])) {
      while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
      const std::size_t next = text.find_first_not_of(" \t\n", end);
      check_name(text, std::string_view(text).substr(i, end - i), next != std::string::npos && text[next] == '(');
    } else if (is_digit(text[i]) || text[i] == '.') {
      end = i + std::max<std::size_t>(1, number_length(text, i));
    } else if (std::string_view("+-*/^() \t\n").find(text[i]) == std::string_view::npos) {
      refuse(text, fmt::format("the character {} means nothing here", text[i]));
    }
    if (powers.follows(text[i])) refuse(text, "a^b^c needs parentheses, as in a^(b^c)");
    depth += text[i] == '(' ? 1 : (text[i] == ')' ? -1 : 0);
    if (depth > deepest_nesting) refuse(text, fmt::format("parentheses are nested deeper than {}", deepest_nesting));
    i = end;
  }
  if (depth != 0) refuse(text, "its parentheses do not match");
}

/// GiNaC leaves the derivative of step standing; it is zero everywhere but at the jump, which check_steps looks at.
struct DropStepSlopes : GiNaC::map_function {
  ex operator()(const ex& e) override { return GiNaC::is_a<GiNaC::fderivative>(e) ? ex(0) : e.map(*this); }
};

/// Puts each step at the value it has just before or just after `instant`.
struct FixSteps : GiNaC::map_function {
  FixSteps(const ex& t, const ex& instant, int side) : t_(t), instant_(instant), side_(side) {}
  ex operator()(const ex& e) override {
    if (!GiNaC::is_exactly_a<GiNaC::function>(e) || !e.match(GiNaC::step(GiNaC::wild()))) return e.map(*this);
    const ex here = e.op(0).subs(t_ == instant_).evalf();
    const ex near = here.is_zero() ? e.op(0).coeff(t_, 1).evalf() * side_ : here;
    return GiNaC::ex_to<GiNaC::numeric>(near).is_positive() ? ex(1) : ex(0);
  }
  ex t_, instant_;
  int side_;
};

void check_steps(const std::string& text, const ex& e, const ex& t) {
  GiNaC::exset steps;
  e.find(GiNaC::step(GiNaC::wild()), steps);
  for (const ex& one : steps) {
    const ex argument = one.op(0).expand();
    if (!argument.is_polynomial(t) || argument.degree(t) != 1 || argument.has(GiNaC::step(GiNaC::wild())))
      refuse(text, "step takes a + b*t only, so that a jump of the position can be found");
    const ex instant = (-argument.coeff(t, 0) / argument.coeff(t, 1)).evalf();
    FixSteps before(t, instant, -1), after(t, instant, 1);
    const ex left = before(e).subs(t == instant).evalf();
    const ex right = after(e).subs(t == instant).evalf();
    if (GiNaC::abs(right - left).evalf() > GiNaC::abs(left).evalf() * 1e-9 + 1e-12)
      refuse(text, fmt::format("the position jumps at t = {} s", GiNaC::ex_to<GiNaC::numeric>(instant).to_double()));
  }
}

ex parse(const std::string& text, const GiNaC::realsymbol& t) {
  GiNaC::parser parser({{"t", t}, {"pi", GiNaC::Pi}}, true);
  const ex e = parser(text);
  for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
    if (GiNaC::is_a<GiNaC::numeric>(*part) && !GiNaC::ex_to<GiNaC::numeric>(*part).is_real())
      refuse(text, "it is not a real number");
  return e;
}

std::string formula(const ex& e);

/// The operands' formulas in an order of their own.
std::string joined(std::vector<std::string> operands, const char* sign) {
  std::sort(operands.begin(), operands.end());
  return fmt::format("({})", fmt::join(operands, sign));
}

std::string product(const ex& e) {
  std::vector<std::string> above, below;
  for (const ex& factor : e) {
    const bool divides = GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::negative);
    divides ? below.push_back(formula(1 / factor)) : above.push_back(formula(factor));
  }
  if (above.empty()) above.emplace_back("1.0");
  return below.empty() ? joined(above, "*") : joined(above, "*") + "/" + joined(below, "*");
}

/// In C notation.  GiNaC's own order of operands depends on addresses in memory.  Two processes would then round sums
/// differently.
std::string formula(const ex& e) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  std::vector<std::string> operands;
  if (GiNaC::is_a<GiNaC::mul>(e)) return product(e);
  if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::function>(e) || GiNaC::is_a<GiNaC::power>(e))
    for (const ex& operand : e) operands.push_back(formula(operand));
  if (GiNaC::is_a<GiNaC::add>(e)) return joined(operands, "+");
  if (GiNaC::is_a<GiNaC::power>(e)) return fmt::format("pow({},{})", operands[0], operands[1]);
  if (GiNaC::is_a<GiNaC::function>(e))
    return fmt::format("{}({})", GiNaC::ex_to<GiNaC::function>(e).get_name(), operands[0]);
  out << GiNaC::csrc_double << e;
  return out.str();
}

/// x, dx/dt, d2x/dt2 in C notation, which muParser reads with `pow` and `Pi` added.
std::string derivatives_as_text(const std::string& text) {
  const GiNaC::realsymbol t("t");
  DropStepSlopes drop_step_slopes;
  const ex x = parse(text, t);
  check_steps(text, x, t);
  const ex v = drop_step_slopes(x.diff(t));
  const ex a = drop_step_slopes(v.diff(t));
  return fmt::format("{} , {} , {}", formula(x), formula(v), formula(a));
}

/// GiNaC's complaints in the words of someone who writes a scene.
std::string plain_words(const std::string& complaint) {
  if (complaint.find("expected EOF") != std::string::npos)
    return "an operator is missing or a parenthesis is out of place (2*t, not 2t)";
  if (complaint.find("unexpected token") != std::string::npos) return "a number, a name or a parenthesis is missing";
  return complaint.substr(0, complaint.find('\n'));
}

}   // namespace

Expression::Expression(const std::string& text) : compiled_(std::make_unique<Compiled>()) {
  check_tokens(text);
  mu::Parser& parser = compiled_->parser;
  try {
    parser.ClearFun();
    parser.ClearConst();
    for (const Function& function : functions) parser.DefineFun(function.name, function.evaluate);
    parser.DefineFun("pow", power);
    parser.DefineConst("Pi", M_PI);
    parser.DefineVar("t", &compiled_->t);
    parser.SetExpr(derivatives_as_text(text));
    at(0);
  } catch (const mu::Parser::exception_type& error) {
    refuse(text, fmt::format("it or a derivative is not a real function ({})", error.GetMsg()));
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    refuse(text, plain_words(error.what()));
  }
}

Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;

std::array<double, 3> Expression::at(double t) const {
  compiled_->t = t;
  int count = 0;
  const double* values = compiled_->parser.Eval(count);
  return {values[0], values[1], values[2]};
}

}   // namespace cablenet::scene
