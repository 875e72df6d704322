#pragma once
/// Values in a part program other than plain numbers: parameters (#5, #<depth>) and expressions ([#1 + 2 * SIN[30]]).
#include <cstddef>
#include <string>

#include "core/contour/gcode/words/parameters.hpp"

namespace bahnwerk::gcode {

/// Reads from `at` on, at most to `end`; no line end lies before it. Blanks may be anywhere, and case does not matter.
/// Numbers may have an exponent, 1.5e-3.
///
/// Operators by precedence, equal ones from the left: **, then * / MOD, then + -, then EQ NE GT GE LT LE, then AND OR
/// XOR. A value other than zero is true; EQ and NE take numbers within 1e-6 as equal. MOD is never negative. Functions:
/// ABS ACOS ASIN ATAN[y]/[x] COS EXISTS[#<name>] EXP FIX FUP LN ROUND SIN SQRT TAN; angles in degrees.
class Expression {
 public:
  static constexpr int max_depth = 32;  ///< depth of nested brackets and parameters

  Expression(const char* at, const char* end, std::size_t line, Parameters& parameters)
      : at_(at), end_(end), line_(line), parameters_(parameters) {}

  /// Reads a number, a parameter, an expression in brackets or a function, with signs. Returns false with fault().
  bool value(double& result);

  /// A parameter by number or by name.
  struct Reference {
    int number = 0;
    std::string name;  ///< name of the parameter; empty: it has a number
  };
  bool reference(Reference& result);
  /// Reads the name between < and >.
  bool name(std::string& result);

  void skip_blanks();
  bool next_is(char c);  ///< whether the next character is c, which is then consumed
  const char* at() const { return at_; }
  const std::string& fault() const { return fault_; }

 private:
  bool fail(std::string why);
  bool number(double& result, bool exponents);
  bool parameter(double& result);
  bool function(double& result);
  bool atan(double& result);
  bool exists(double& result);
  bool brackets(double& result);
  bool operation(double& result, int rank);
  int operator_here(std::size_t& length) const;
  bool apply(int op, double& left, double right);
  bool finite(double value) { return value - value == 0 || fail("the expression has no finite value"); }

  const char *at_, *end_;
  std::size_t line_;
  Parameters& parameters_;
  std::string fault_;
  int depth_ = 0;
};

}  // namespace bahnwerk::gcode
