// Thousands of broken programs: reading one ends quickly, in a contour or in faults with their lines.

#include "core/numeric/random.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

const char* const programs[] = {
    "%\nO1 (plate)\nN10 G17 G21 G90 G94\nG0 X40 Y35\nM3 S200\nG1 X80. F2400\nG3 X80 Y45 J5\nG1 X40\nG3 X40 Y35 R5\nM5\n"
    "G0 X0 Y0 Z5\nG2 I10 Z-5 P4\nM30\n%\n",
    "G20 G91\nF10 G1 X1 Y.5\nG5 I0 J3 P0 Q-3 X4 Y2\nP-5 Q3 X9 Y4\nG5.1 X2 I2 J-8\nG90 G1 X1 Y0\nG90.1 G3 X0 Y1 I0 "
    "J0\n/X4\nG4 "
    "P1\n",
    "G54 G0 X0 Y0 Z9\nG41 D1 G1 X10 F60\nG3 X20 Y10 J10\nG1 Y30\nG2 X15 Y35 R5\nG1 X0\nG40 G1 Y40 X-9\nG98 G83 X3 Z-2 "
    "R1 "
    "Q1 "
    "L2\nG82 "
    "X9 R3 Z1 P.1\nG80\nG93 G1 X1 F3\nG94 F9\nG92 X0\nG52 Y1\nG55 X5\nG28 Z1\nG0 Z3\nG1 X2 E4\nM104 S2",
    "#1=0\no1 while [#1 LT 4]\n#1=[#1+1]\no2 if [#1 EQ 2]\nG1 X[#1*SIN[30]] Y##1\no2 elseif [#1 GT 3 OR 0]\no1 "
    "continue\no2 else\no3 call [#1] [2]\no2 endif\no1 endwhile\no3 sub\nG91 G1 X#1 Y-#2\no3 endsub [4**.5]\no4 repeat "
    "[2]\nX3\no4 endrepeat\nM98 P9 L2\nM30\nO9\nG1 Y1\nM99",
    "G18 G0 X0 Y0 Z10\nG3 X10 Z0 I0 K-10\nG19 G2 Y5 Z5 R-5\nM62 P1\nG17 G1 X3\nM63 P1\r\nG28 Z0\rM2\n",
};

std::string mutated(std::string text, Random& random) {
  const char* const words[] = {"G2",         "G3",
                               "G5",         "G5.1",
                               "G91",        "G20",
                               "G18",        "I0",
                               "J-1",        "R1",
                               "R-3",        "P7",
                               "X",          "Y1e5",
                               "Z.5",        "M3",
                               "M5",         "F1",
                               "F0",         "%",
                               "\n",         "(",
                               ")",          ";",
                               "/",          "#",
                               "X999999999", "0.0000001",
                               " ",          "-",
                               "P1000",      "G28",
                               "M98",        "O5",
                               "\r\n",       "G90.1",
                               "nan",        "\xFF",
                               "G80",        "K1",
                               "G41 D1",     "G42 D2",
                               "G40",        "G55",
                               "G92",        "G28",
                               "G93",        "G81 R2 Z1",
                               "L3",         "E1",
                               "#1",         "#1=2",
                               "[",          "]",
                               "[#1+1]",     "o1 endif",
                               "o2 break",   "o1 while [1]",
                               "o3 return",  "M98 P9",
                               "M99",        "G53",
                               "G10 L2 P1",  "D3",
                               "G41.1",      "MOD",
                               "**",         "ATAN[1]/[2]",
                               "<_value>",   "M70",
                               "M72",        "M73",
                               "e-3",        "E-05",
                               "$H",         "$0",
                               "M666 X1",    "M862.3 P \"a b\"",
                               "G5.1 Q1",    "G28 W",
                               "#<_x>",      "\x1A",
                               "(a (b) c)",  "M6",
                               "G10 L20 P2", "G28.1",
                               "G50",        "H2",
                               "G83 P1"};
  for (std::uint64_t n = 1 + random.below(2); n > 0; --n) {
    const std::size_t at = random.below(text.size() + 1);
    switch (random.below(5)) {
      case 0:
        text.insert(at, words[random.below(std::size(words))]);
        break;
      case 1:
        text.erase(at, random.below(6));
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random.below(256));
        break;
      case 3:
        if (at < text.size()) text[at] = "0123456789.-"[random.below(12)];
        break;
      default:
        text.insert(at, text.substr(random.below(text.size() + 1), random.below(40)));
    }
    if (text.empty()) text = "G1";
  }
  return text;
}

TEST(GcodeMutation, BeginsWithGoodPrograms) {
  for (const char* text : programs) {
    GcodeOptions options;
    options.cutter_radius = {{1, 2.0}};
    const auto faults = gcode_faults(text, options);
    EXPECT_TRUE(faults.empty()) << faults.front().message;
  }
}

TEST(GcodeMutation, ReadsOrRefuses) {
  Random random(20240611);
  GcodeOptions options;
  options.max_segments = 2'000;
  options.steps = 2'000;
  options.cutter_radius = {{1, 2.0}, {2, -0.5}, {3, 0.01}};
  options.work_offsets[1] = Vec{10, 20, 1};
  options.g30 = Vec{0, 0, 50};
  int good = 0, bad = 0;
  for (int run = 0; run < testing::cases(40'000); ++run) {
    const std::string text = mutated(programs[random.below(std::size(programs))], random);
    try {
      const Contour c = read_gcode(text, options);
      ++good;
      ASSERT_GT(c.path.length(), 0) << text;
      ASSERT_EQ(c.blocks.back().last, c.path.size()) << text;
      for (std::size_t i = 1; i < c.path.size(); ++i) {
        const Vec gap = end_of(c.path[i - 1]) - begin_of(c.path[i]);
        // Huge circles close to the rounding of their radius.
        const double size = 1 + norm(begin_of(c.path[i])) + 1e-6 * c.path[i - 1].length();
        ASSERT_LT(norm(gap), 1e-9 * size) << text;
      }
    } catch (const InvalidInput& e) {
      ++bad;
      for (const InputFault& fault : e.faults) {
        ASSERT_EQ(fault.place.size(), 2u) << text;
        ASSERT_EQ(fault.message.rfind("line ", 0), 0u) << text;
      }
    }
  }
  // Both happen often, and none takes long: `steps` and `max_segments` end each.
  EXPECT_GT(20 * good, testing::cases(40'000));
  EXPECT_GT(20 * bad, testing::cases(40'000));
}

}  // namespace
}  // namespace bahnwerk
