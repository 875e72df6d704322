// Thousands of broken programs: reading one ends quickly, in a contour or in faults with their lines.
#include <chrono>

#include "core/numeric/random.hpp"
#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

const char* const programs[] = {
    "%\nO1 (plate)\nN10 G17 G21 G90 G94\nG0 X40 Y35\nM3 S200\nG1 X80. F2400\nG3 X80 Y45 J5\nG1 X40\nG3 X40 Y35 R5\nM5\n"
    "G0 X0 Y0 Z5\nG2 I10 Z-5 P4\nM30\n%\n",
    "G20 G91\nF10 G1 X1 Y.5\nG5 I0 J3 P0 Q-3 X4 Y2\nP-5 Q3 X9 Y4\nG5.1 X2 I2 J-8\nG90 G1 X1 Y0\nG90.1 G3 X0 Y1 I0 "
    "J0\n/X4\nG4 "
    "P1\n",
    "G18 G0 X0 Y0 Z10\nG3 X10 Z0 I0 K-10\nG19 G2 Y5 Z5 R-5\nM62 P1\nG17 G1 X3\nM63 P1\r\nG28 Z0\rM2\n",
};

std::string mutated(std::string text, Random& random) {
  const char* const words[] = {"G2",    "G3",  "G5",  "G5.1", "G91",  "G20",   "G18",        "I0",        "J-1", "R1",
                               "R-3",   "P7",  "X",   "Y1e5", "Z.5",  "M3",    "M5",         "F1",        "F0",  "%",
                               "\n",    "(",   ")",   ";",    "/",    "#",     "X999999999", "0.0000001", " ",   "-",
                               "P1000", "G28", "M98", "O5",   "\r\n", "G90.1", "nan",        "\xFF",      "G80", "K1"};
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
    const auto faults = gcode_faults(text);
    EXPECT_TRUE(faults.empty()) << faults.front().message;
  }
}

TEST(GcodeMutation, ReadsOrRefuses) {
  Random random(20240611);
  GcodeOptions options;
  options.max_segments = 2'000;
  int good = 0, bad = 0;
  double worst = 0;
  for (int run = 0; run < 20'000; ++run) {
    const std::string text = mutated(programs[random.below(std::size(programs))], random);
    const auto begin = std::chrono::steady_clock::now();
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
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    worst = std::max(worst, took.count());
  }
  // Both happen often, and none takes long (an arc or spline costs some µs).
  EXPECT_GT(good, 2'000);
  EXPECT_GT(bad, 2'000);
  EXPECT_LT(worst, 0.5);
}

}  // namespace
}  // namespace bahnwerk
