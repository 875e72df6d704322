#include "core/contour/gcode/words/expression.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>

#include "core/contour/gcode/words/characters.hpp"
#include "core/contour/gcode/words/number_exponent.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double equal = 1e-6;  // EQ, NE
constexpr std::size_t max_name = 256;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

enum Operator { power, times, divided, modulo, plus, minus, eq, ne, gt, ge, lt, le, land, lor, lxor };
constexpr std::string_view names[] = {"**", "*",  "/",  "mod", "+",   "-",  "eq", "ne",
                                      "gt", "ge", "lt", "le",  "and", "or", "xor"};
constexpr int rank_of[] = {5, 4, 4, 4, 3, 3, 2, 2, 2, 2, 2, 2, 1, 1, 1};

enum Function {
  f_abs,
  f_acos,
  f_asin,
  f_atan,
  f_cos,
  f_exists,
  f_exp,
  f_fix,
  f_fup,
  f_ln,
  f_round,
  f_sin,
  f_sqrt,
  f_tan
};
constexpr std::string_view functions[] = {"abs", "acos", "asin", "atan",  "cos", "exists", "exp",
                                          "fix", "fup",  "ln",   "round", "sin", "sqrt",   "tan"};

double applied(int function, double x) {
  switch (function) {
    case f_abs:
      return std::abs(x);
    case f_acos:
      return std::acos(x) / degree;
    case f_asin:
      return std::asin(x) / degree;
    case f_cos:
      return std::cos(x * degree);
    case f_exp:
      return std::exp(x);
    case f_fix:
      return std::floor(x);
    case f_fup:
      return std::ceil(x);
    case f_ln:
      return std::log(x);
    case f_round:
      return std::round(x);
    case f_sin:
      return std::sin(x * degree);
    case f_sqrt:
      return std::sqrt(x);
    default:
      return std::tan(x * degree);
  }
}

}  // namespace

bool Expression::fail(std::string why) {
  if (fault_.empty()) fault_ = std::move(why);
  return false;
}

void Expression::skip_blanks() {
  while (at_ != end_ && blank(*at_)) ++at_;
}

bool Expression::next_is(char c) {
  skip_blanks();
  if (at_ == end_ || *at_ != c) return false;
  ++at_;
  return true;
}

bool Expression::value(double& result) {
  skip_blanks();
  if (at_ == end_) return fail("a value is missing");
  if (part_of_number(*at_)) return number(result, true);
  if (++depth_ > max_depth) return fail("more than 32 brackets or parameters in one another");
  bool read = false;
  if (*at_ == '+' || *at_ == '-') {
    const bool negative = *at_++ == '-';
    read = value(result);
    if (negative) result = -result;
  } else if (*at_ == '[') {
    ++at_;
    read = brackets(result);
  } else if (*at_ == '#') {
    ++at_;
    read = parameter(result);
  } else if (is_letter(*at_)) {
    read = function(result);
  } else {
    read = fail("a value is missing");
  }
  --depth_;
  return read;
}

bool Expression::number(double& result, bool exponents) {
  std::array<char, 64> text;
  std::size_t size = 0;
  for (; at_ != end_ && (part_of_number(*at_) || blank(*at_)); ++at_) {
    if (blank(*at_)) continue;
    if (size == text.size()) return fail("a number is too long");
    text[size++] = *at_;
  }
  if (exponents && at_ != end_ && !blank(at_[-1])) {
    const std::size_t more = exponent_size({at_, static_cast<std::size_t>(end_ - at_)});
    if (size + more > text.size()) return fail("a number is too long");
    for (std::size_t i = 0; i < more; ++i) text[size++] = *at_++;
  }
  const auto [stop, error] = std::from_chars(text.data(), text.data() + size, result);
  return (error == std::errc{} && stop == text.data() + size) || fail("what should be a number is none");
}

bool Expression::name(std::string& result) {
  if (!next_is('<')) return fail("a name is missing");
  result.clear();
  for (; at_ != end_ && *at_ != '>'; ++at_) {
    if (blank(*at_)) continue;
    if (result.size() == max_name) return fail("a name is too long");
    result += lower(*at_);
  }
  if (at_ == end_) return fail("a name does not end: > is missing");
  ++at_;
  return !result.empty() || fail("a name is missing");
}

bool Expression::reference(Reference& result) {
  skip_blanks();
  result.name.clear();
  if (at_ != end_ && *at_ == '<') return name(result.name);
  double number = 0;
  // A digit alone ends before a word E: X#1E5.
  if (at_ != end_ && part_of_number(*at_) ? !this->number(number, false) : !value(number)) return false;
  if (!(number >= 1 && number <= Parameters::most && std::abs(number - std::round(number)) <= equal))
    return fail("a parameter's number is a whole one from 1 to 9999");
  result.number = static_cast<int>(std::round(number));
  return true;
}

bool Expression::parameter(double& result) {
  Reference which;
  if (!reference(which)) return false;
  if (which.name.empty()) {
    result = parameters_.get(which.number, line_);
    return true;
  }
  const auto found = parameters_.get(which.name, line_);
  if (!found && parameters_.of_the_machine(which.name))
    return fail("the parameter #<" + which.name + "> is a value of the machine, which is not known here");
  if (!found) return fail("the parameter #<" + which.name + "> was not set");
  result = *found;
  return true;
}

bool Expression::function(double& result) {
  std::array<char, 8> word;
  std::size_t size = 0;
  while (at_ != end_ && is_letter(*at_) && size < word.size()) word[size++] = lower(*at_++);
  const std::string_view name(word.data(), size);
  for (std::size_t f = 0; f < std::size(functions); ++f) {
    if (functions[f] != name) continue;
    if (f == f_exists) return exists(result);
    if (!next_is('[')) return fail("a function's value stands in brackets");
    if (!brackets(result)) return false;
    if (f == f_atan) return atan(result);
    result = applied(static_cast<int>(f), result);
    return finite(result);
  }
  return fail("there is no function " + std::string(name));
}

/// Reads ATAN[y]/[x], within ±180°.
bool Expression::atan(double& result) {
  double x = 0;
  if (!next_is('/') || !next_is('[')) return fail("ATAN has two values: ATAN[y]/[x]");
  if (!brackets(x)) return false;
  result = std::atan2(result, x) / degree;
  return finite(result);
}

bool Expression::exists(double& result) {
  std::string which;
  if (!next_is('[') || !next_is('#') || !name(which) || !next_is(']'))
    return fail("EXISTS asks for a name: EXISTS[#<name>]");
  result = parameters_.get(which, line_) ? 1 : 0;
  return true;
}

/// Reads an expression after its [, up to the ].
bool Expression::brackets(double& result) {
  if (!operation(result, 1)) return false;
  return next_is(']') || fail("an expression does not end: ] is missing");
}

int Expression::operator_here(std::size_t& length) const {
  if (at_ == end_ || *at_ == ']') return -1;
  for (std::size_t op = 0; op < std::size(names); ++op) {
    const std::string_view name = names[op];
    std::size_t i = 0;
    while (i < name.size() && at_ + i != end_ && lower(at_[i]) == name[i]) ++i;
    if (i < name.size()) continue;
    length = name.size();
    return static_cast<int>(op);
  }
  return -1;
}

/// Reads operators of this rank and above; equal ones are evaluated from the left.
bool Expression::operation(double& result, int rank) {
  if (!value(result)) return false;
  for (;;) {
    skip_blanks();
    std::size_t length = 0;
    const int op = operator_here(length);
    if (op < 0 || rank_of[op] < rank) return true;
    at_ += length;
    double right = 0;
    if (!operation(right, rank_of[op] + 1) || !apply(op, result, right)) return false;
  }
}

bool Expression::apply(int op, double& left, double right) {
  switch (op) {
    case power:
      left = std::pow(left, right);
      return finite(left);
    case times:
      left *= right;
      return finite(left);
    case divided:
      if (right == 0) return fail("a division by zero");
      left /= right;
      return finite(left);
    case modulo:
      if (right == 0) return fail("a division by zero (MOD)");
      left = std::fmod(left, right);
      if (left < 0) left += std::abs(right);
      return true;
    case plus:
      left += right;
      return finite(left);
    case minus:
      left -= right;
      return finite(left);
    default:
      break;
  }
  const bool same = std::abs(left - right) <= equal, a = left != 0, b = right != 0;
  const bool holds[] = {same, !same, left > right, left >= right, left < right, left <= right, a && b, a || b, a != b};
  left = holds[op - eq] ? 1 : 0;
  return true;
}

}  // namespace bahnwerk::gcode
