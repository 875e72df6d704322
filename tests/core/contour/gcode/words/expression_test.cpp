#include "core/contour/gcode/words/expression.hpp"

#include <cmath>

#include "core/numeric/random.hpp"
#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk::gcode {
namespace {

struct NoSystem final : SystemParameters {
  std::optional<double> system_parameter(int number) const override { return number; }
  std::optional<double> predefined(std::string_view name) const override {
    return name == "_x" ? std::optional(7.0) : std::nullopt;
  }
  bool of_the_machine(std::string_view name) const override { return name == "_task"; }
};

double value(const std::string& text) {
  const NoSystem system;
  Parameters parameters(system);
  parameters.set(1, 4);
  parameters.set(4, 1.5);
  parameters.set("depth", -3);
  Expression expression(text.data(), text.data() + text.size(), 1, parameters);
  double result = 0;
  EXPECT_TRUE(expression.value(result)) << text << ": " << expression.fault();
  EXPECT_EQ(expression.at(), text.data() + text.size()) << text;
  return result;
}

TEST(GcodeExpression, Values) {
  const std::pair<const char*, double> cases[] = {
      {"3", 3},
      {"- 2 .5", -2.5},
      {"[1+2*3]", 7},
      {"[[1+2]*3]", 9},
      {"[2**3**2]", 64},  // from the left
      {"[2*3**2]", 18},
      {"[-2**2]", 4},  // the sign belongs to the number
      {"[10 - 4 - 3]", 3},
      {"[7 MOD 4]", 3},
      {"[-7 mod 4]", 1},
      {"[1 - -1]", 2},
      {"[2.0 / 3 * 1.5 - 5.5 / 11.0]", 0.5},  // NISTIR 6556, 3.3.2.3
      {"#1", 4},
      {"##1", 1.5},
      {"#[2+2]", 1.5},
      {"-#1", -4},
      {"#<depth>", -3},
      {"#< De pth >", -3},
      {"#5220", 5220},
      {"SIN[30]", 0.5},
      {"cos[60]", 0.5},
      {"tan[45]", 1},
      {"asin[0.5]", 30},
      {"acos[0.5]", 60},
      {"atan[1]/[-1]", 135},
      {"ATAN[-1]/[-1]", -135},
      {"sqrt[16]", 4},
      {"abs[-2.5]", 2.5},
      {"fix[2.8]", 2},
      {"fix[-2.8]", -3},
      {"fup[2.2]", 3},
      {"fup[-2.8]", -2},
      {"round[2.5]", 3},
      {"round[-2.5]", -3},
      {"exp[0]", 1},
      {"ln[exp[2]]", 2},
      {"exists[#<depth>]", 1},
      {"exists[#<height>]", 0},
      {"[1 LT 2 AND 3 GE 3]", 1},
      {"[1 GT 2 OR 3 NE 3]", 0},
      {"[1 XOR 1]", 0},
      {"[5 AND -1]", 1},
      {"[1 + 1 EQ 2]", 1},
      {"[0.1 + 0.2 EQ 0.3]", 1},
      {"[1 LE 0.5]", 0},
  };
  for (const auto& [text, expected] : cases) EXPECT_NEAR(value(text), expected, 1e-12) << text;
}

/// A random expression, with every pair in brackets, and its value.
std::string random_expression(Random& random, int depth, double& result) {
  char text[40];
  if (depth == 0 || random.chance(0.2)) {
    result = std::round(random.uniform(-50, 50) * 16) / 16;
    std::snprintf(text, sizeof text, "%.4f", result);
    return text;
  }
  double a = 0, b = 0;
  const std::string left = random_expression(random, depth - 1, a), right = random_expression(random, depth - 1, b);
  switch (random.below(7)) {
    case 0:
      result = a + b;
      return "[" + left + "+" + right + "]";
    case 1:
      result = a - b;
      return "[" + left + " - " + right + "]";
    case 2:
      result = a * b;
      return "[" + left + "*" + right + "]";
    case 3:
      result = a < b;
      return "[" + left + " LT " + right + "]";
    case 4:
      result = std::abs(a);
      return "ABS[" + left + "]";
    case 5:
      result = std::sin(a * std::acos(-1.0) / 180);
      return "SIN[" + left + "]";
    default:
      result = std::floor(a);
      return "FIX[" + left + "]";
  }
}

TEST(GcodeExpression, RandomOnes) {
  Random random(11);
  for (int run = 0; run < 2000; ++run) {
    double expected = 0;
    const std::string text = random_expression(random, 6, expected);
    ASSERT_NEAR(value(text), expected, 1e-9 * (1 + std::abs(expected))) << text;
  }
}

TEST(GcodeExpression, RanksNeedNoBrackets) {
  // a op b op c with random operators against the ranks, written out with brackets.
  const char* names[] = {"**", "*", "/", "+", "-", "LT", "GE", "AND", "OR"};
  const int ranks[] = {5, 4, 4, 3, 3, 2, 2, 1, 1};
  Random random(12);
  for (int run = 0; run < 2000; ++run) {
    const std::size_t p = random.below(9), q = random.below(9);
    std::string n[3];
    for (auto& one : n) one = std::to_string(1 + random.below(9));
    const std::string plain = "[" + n[0] + " " + names[p] + " " + n[1] + " " + names[q] + " " + n[2] + "]";
    const std::string grouped = ranks[p] >= ranks[q]
                                    ? "[[" + n[0] + " " + names[p] + " " + n[1] + "] " + names[q] + " " + n[2] + "]"
                                    : "[" + n[0] + " " + names[p] + " [" + n[1] + " " + names[q] + " " + n[2] + "]]";
    ASSERT_EQ(value(plain), value(grouped)) << plain;
  }
}

TEST(GcodeExpression, DepthIsBounded) {
  const auto nested = [](int depth) {
    return std::string(static_cast<std::size_t>(depth), '[') + "1" + std::string(static_cast<std::size_t>(depth), ']');
  };
  EXPECT_EQ(value(nested(32)), 1);
  for (const std::string& deep :
       {nested(33), nested(1'000'000), std::string(1'000'000, '-') + "1", std::string(1'000'000, '#') + "1"})
    EXPECT_EQ(fault_lines("G1 X" + deep), (std::vector{1}));
}

}  // namespace
}  // namespace bahnwerk::gcode
