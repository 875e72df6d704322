// Subprograms, branches and loops: the order of the lines, and its bounds.
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

/// X of every move of a program.
std::vector<double> xs(const std::string& text) {
  const Contour c = read_gcode("F60 G1\n" + text);
  std::vector<double> list;
  for (std::size_t i = 0; i < c.path.size(); ++i) list.push_back(end_of(c.path[i]).x);
  return list;
}
using List = std::vector<double>;

TEST(GcodeControl, Parameters) {
  // What a line sets holds from the next one on.
  EXPECT_EQ(xs("#3=6\n#3=15 X#3\nX#3"), (List{6, 15}));
  EXPECT_EQ(xs("#<a b>=2 #1=3\nX[#<AB>*#1]\nX[#5420+1]"), (List{6, 7}));
  EXPECT_EQ(xs("G55\nX4\n#1=#5220\nX#1"), (List{4, 2}));
  EXPECT_EQ(xs("#1=20\nG#[1] X5\nG[#1+1] X[3*2]"), (List{127, 6}));
  const Contour unset = read_gcode("F60 G1 X[#8+1]\nX[#9+2]");
  ASSERT_EQ(unset.notes.size(), 1u);
  EXPECT_EQ(unset.notes[0], "line 1 and 1 more: the parameter #8 was read before it was set: taken as 0");
}

TEST(GcodeControl, Branches) {
  const std::string branch =
      "o1 if [#1 EQ 1]\nX1\no1 elseif [#1 EQ 2]\nX2\no1 elseif [#1 EQ 3]\nX3\no1 else\nX4\no1 endif\nX9";
  for (int i = 1; i <= 4; ++i) EXPECT_EQ(xs("#1=" + std::to_string(i) + "\n" + branch), (List{double(i), 9}));
  EXPECT_EQ(xs("o1 if [0]\nX1\no1 endif\nX2"), (List{2}));
  EXPECT_EQ(xs("o1 if [1]\no2 if [0]\nX1\no2 else\nX2\no2 endif\no1 else\nX3\no1 endif\nX4"), (List{2, 4}));
}

TEST(GcodeControl, Loops) {
  EXPECT_EQ(xs("#1=0\nO101 while [#1 LT 3]\n#1=[#1+1]\nX#1\nO101 endwhile\nX9"), (List{1, 2, 3, 9}));
  EXPECT_EQ(xs("#1=5\no1 do\nX#1\n#1=[#1+1]\no1 while [#1 LT 3]\nX9"), (List{5, 9}));
  EXPECT_EQ(xs("#1=1\no1 do\nX#1\n#1=[#1+1]\no1 while [#1 LT 3]\nX9"), (List{1, 2, 9}));
  EXPECT_EQ(xs("G91\no1 repeat [3]\nX1\no2 repeat [2]\nX.25\no2 endrepeat\no1 endrepeat"),
            (List{1, 1.25, 1.5, 2.5, 2.75, 3, 4, 4.25, 4.5}));
  EXPECT_EQ(xs("o1 repeat [0]\nX1\no1 endrepeat\no2 while [0]\nX2\no2 endwhile\nX9"), (List{9}));
  EXPECT_EQ(xs("#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\no3 if [#1 GT 3]\no1 break\no3 "
               "endif\nX#1\no1 endwhile\nX9"),
            (List{1, 3, 9}));
  EXPECT_EQ(xs("#1=0\no1 repeat [4]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nX#1\no1 endrepeat"),
            (List{1, 3, 4}));
  EXPECT_EQ(xs("#1=0\no1 do\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nX#1\no1 while [#1 LT 4]"),
            (List{1, 3, 4}));
  // A label may be used again.
  EXPECT_EQ(xs("o1 if [1]\nX1\no1 endif\no1 if [0]\nX2\no1 endif\no1 repeat [1]\nX3\no1 endrepeat"), (List{1, 3}));
}

TEST(GcodeControl, Subprograms) {
  EXPECT_EQ(
      xs("o<hole> sub\nX#1\nX[#1+#2]\n#40=#1\no<hole> endsub\n#1=7\no<hole> call [3] [4]\no<HOLE> call [5]\nX#1\nX#40"),
      (List{3, 7, 5, 7, 5}));  // #2 of the second call is as outside, 0: no move
  EXPECT_EQ(
      xs("o5 sub\no6 if [#1 GT 3]\no5 return [#1]\no6 endif\no7 call [#1+1]\no5 endsub [#<_value>*2]\no7 sub\nX#1\no7 "
         "endsub [20]\no5 call [1]\nX#<_value>\no5 call [8]\nX[#<_value>+#<_value_returned>]"),
      (List{2, 40, 9}));
  // Names of a subprogram are its own, those with _ are everyone's; it may call itself.
  EXPECT_EQ(xs("#<a>=1\n#<_b>=2\no1 sub\n#<a>=5\n#<_b>=6\no1 endsub\no1 call\nX#<a>\nX#<_b>"), (List{1, 6}));
  EXPECT_EQ(xs("o1 sub\nX#1\no2 if [#1 GT 1]\no1 call [#1-1]\no2 endif\nX[#1+0.5]\no1 endsub\no1 call [3]"),
            (List{3, 2, 1, 1.5, 2.5, 3.5}));
  EXPECT_EQ(xs("o103 sub\nX3\no103 endsub\n#101=100\no[#101+3] call"), (List{3}));
}

TEST(GcodeControl, NumberedSubprograms) {
  EXPECT_EQ(xs("G91 X1\nM98 P100 L2\nM98 P200 L0\nX5\nM30\nO100 (first)\nX2\nM98 P200\nM99\nO0200\nX.5\nM99\n%"),
            (List{1, 3, 3.5, 5.5, 6, 11}));
  EXPECT_EQ(xs("G91 X1\nM98 P30100\nM30\nO100\nX2\nM99"), (List{1, 3, 5, 7}));
  // They share the parameters.
  EXPECT_EQ(xs("#1=0\nM98 P1 L3\nX#1\nM2\nO1\n#1=[#1+1]\nM99"), (List{3}));
  const Contour endless = read_gcode("F60 G1 X1\nM99\nX2");
  EXPECT_EQ(endless.path.size(), 1u);
  EXPECT_NE(endless.notes.at(0).find("M99"), std::string::npos);
  EXPECT_TRUE(read_gcode("F60 G1 X1\nM98 P5\nM30\nO5\nX2\nM99\n").notes.empty());
}

TEST(GcodeControl, ALoopIsItsTextRepeated) {
  // The same moves, looped with parameters and written out.
  Random random(3);
  char line[200];
  for (int run = 0; run < 300; ++run) {
    const int outer = static_cast<int>(random.below(5)), inner = static_cast<int>(random.below(5));
    const double step = std::round(random.uniform(-9, 9) * 4) / 4, radius = std::round(random.uniform(1, 9) * 4) / 4;
    const int form = static_cast<int>(random.below(3));
    std::string looped = "F60 G0 X1 Y2\nG1 X3\n#1=0\n", flat = looped;
    const char* const open[] = {"o1 while [#1 LT %d]\n", "o1 repeat [%d]\n", "#9=%d\no1 while [#1 LT #9]\n"};
    std::snprintf(line, sizeof line, open[form], outer);
    looped += line;
    std::snprintf(line, sizeof line,
                  "#2=0\no2 repeat [%d]\nG1 X[#1*%.2f] Y#2\nG2 X[#1*%.2f+%.2f] R%.2f\n#2=[#2+1]\no2 endrepeat\n", inner,
                  step, step, radius, radius);
    looped += line;
    looped += form == 1 ? "#1=[#1+1]\no1 endrepeat\n" : "#1=[#1+1]\no1 endwhile\n";
    for (int i = 0; i < outer; ++i)
      for (int k = 0; k < inner; ++k) {
        std::snprintf(line, sizeof line, "G1 X%.2f Y%d\nG2 X%.2f R%.2f\n", i * step, k, i * step + radius, radius);
        flat += line;
      }
    const Contour a = read_gcode(looped), b = read_gcode(flat);
    ASSERT_EQ(a.path.size(), b.path.size()) << looped;
    for (std::size_t i = 0; i < a.path.size(); ++i) {
      expect_near(end_of(a.path[i]), end_of(b.path[i]), 1e-12);
      ASSERT_NEAR(a.path[i].length(), b.path[i].length(), 1e-9);
    }
  }
}

TEST(GcodeControl, ACallIsItsText) {
  Random random(4);
  for (int run = 0; run < 200; ++run) {
    std::string subs, calls, flat;
    const std::size_t count = 1 + random.below(4);
    std::vector<std::string> bodies;
    for (std::size_t i = 0; i < count; ++i) {
      // Each may call those before it.
      std::string body;
      subs += "o" + std::to_string(10 + i) + " sub\n";
      for (std::size_t n = 1 + random.below(3); n > 0; --n) {
        const bool call = i > 0 && random.chance(0.5);
        const std::size_t which = call ? random.below(i) : 0;
        const std::string move =
            "G91 G1 X" + std::to_string(1 + random.below(9)) + " Y" + std::to_string(random.below(9)) + "\n";
        subs += call ? "o" + std::to_string(10 + which) + " call\n" : move;
        body += call ? bodies[which] : move;
      }
      subs += "o" + std::to_string(10 + i) + " endsub\n";
      bodies.push_back(body);
    }
    for (int n = 0; n < 5; ++n) {
      const std::size_t which = random.below(count);
      calls += "o" + std::to_string(10 + which) + " call\n";
      flat += bodies[which];
    }
    const Contour a = read_gcode("F60\n" + subs + calls), b = read_gcode("F60\n" + flat);
    ASSERT_EQ(a.path.size(), b.path.size()) << subs << calls;
    for (std::size_t i = 0; i < a.path.size(); ++i) expect_near(end_of(a.path[i]), end_of(b.path[i]), 0);
  }
}

TEST(GcodeControl, TheBudgetEndsEveryLoop) {
  for (const char* text :
       {"G1 X1\no1 while [1]\no1 endwhile", "G1 X1\no1 while [1]\n(nothing)\no1 endwhile",
        "G1 X1\no1 do\n#1=[#1+1]\no1 while [1]", "G1 X1\no1 repeat [1000000000]\n#2=SIN[#2+1]\no1 endrepeat",
        "G1 X1\nM98 P5 L100000000\nM30\nO5\nM99",
        "G1 X1\no1 sub\no2 repeat [100]\no3 repeat[100]\no4 repeat[1000]\n#1=1\no4 endrepeat\no3 endrepeat\no2 "
        "endrepeat\no1 endsub\no1 call"}) {
    const auto faults = gcode_faults(text);
    ASSERT_EQ(faults.size(), 1u) << text;
    EXPECT_NE(faults[0].message.find("the budget of 1000000 steps"), std::string::npos) << faults[0].message;
  }
  EXPECT_EQ(fault_lines("G1 X1\no1 repeat [11]\n#1=1\no1 endrepeat", {.steps = 19}).size(), 1u);
  EXPECT_EQ(fault_lines("G1 X1\no1 repeat [11]\n#1=1\no1 endrepeat", {.steps = 20}).size(), 0u);
}

TEST(GcodeControl, LongLinesTakeMoreSteps) {
  std::string text = "G1 X1\no1 repeat [100]\n#1=[0";
  for (int i = 0; i < 5000; ++i) text += "+1";
  text += "]\no1 endrepeat\n";
  EXPECT_EQ(fault_lines(text, {.steps = 99 * 156}), (std::vector{3}));
  EXPECT_TRUE(fault_lines(text, {.steps = 99 * 158}).empty());
}

TEST(GcodeControl, ReadingTheTextIsFree) {
  std::string text = "F60 G1\no1 sub\n";
  for (int i = 0; i < 1000; ++i) text += "#1=[" + std::to_string(i) + "]\n";
  text += "o1 endsub\nX1\n";
  for (int i = 0; i < 1000; ++i)
    text += "o" + std::to_string(i + 2) + " if [0]\no" + std::to_string(i + 2) + " endif\n";
  EXPECT_TRUE(fault_lines(text, {.steps = 1}).empty());
}

TEST(GcodeControl, NestingIsBounded) {
  EXPECT_EQ(fault_lines("G1 X1\no1 sub\no1 call\no1 endsub\no1 call"), (std::vector{3}));
  EXPECT_EQ(fault_lines("G1 X1\nM98 P1\nM2\nO1\nM98 P1\nM99"), (std::vector{5}));
  std::string words = "G1 X1\n";
  for (int i = 0; i < 100'001; ++i) words += "o1 if [1]\no1 endif\n";
  EXPECT_EQ(fault_lines(words), (std::vector{2}));
  std::string many = "G1 X1\n";
  for (int i = 0; i < 1'000'000; ++i) many += "#1=1";
  EXPECT_EQ(fault_lines(many), (std::vector{2}));
  std::string names = "G1 X1\n";
  for (int i = 0; i < 10'001; ++i) names += "#<n" + std::to_string(i) + ">=1\n";
  EXPECT_EQ(fault_lines(names), (std::vector{10'002}));
}

struct StopAtOnce final : ProgressSink {
  std::size_t calls = 0;
  void report(std::string_view, double, std::string_view) override {
    if (++calls == 3) throw std::runtime_error("stopped");
  }
};

TEST(GcodeControl, ProgressIsAsked) {
  StopAtOnce progress;
  EXPECT_THROW(read_gcode("G1 X1\no1 while [1]\no1 endwhile", {.steps = 10'000'000}, progress), std::runtime_error);
}

TEST(GcodeControl, UnmatchedWordsAreFaults) {
  const std::pair<const char*, int> cases[] = {
      {"G1 X1\no1 if [1]\nX2", 2},
      {"G1 X1\no1 sub\nX2", 2},
      {"G1 X1\no1 while [1]\nX2\no1 endif", 4},
      {"G1 X1\no1 repeat [1]\nX2\no1 endwhile", 4},
      {"G1 X1\no1 while [1]\nX2\no1 endrepeat", 4},
      {"G1 X1\no1 if [1]\no1 break\no1 endif", 3},
      {"G1 X1\no1 sub\no1 endsub\no1 sub\no1 endsub", 4},
      {"G1 X1\no1 call", 2},
      {"G1 X1\no1 sub\nM99\no1 endsub\no1 call", 3},
      {"G1 X1\nM98 P7", 2},
      {"G1 X1\nM98 P7\nM2\nO7\nX2", 5},
      {"G1 X1\nM98 P7\nM2\nO7\no8 return\nM99", 5},
      {"G1 X1\no1 call [1] [2", 2},
      {"G1 X1\no1 if [#<x>]\no1 endif", 2},
  };
  for (const auto& [text, at] : cases) EXPECT_EQ(fault_lines(text), (std::vector{at})) << text;
}

TEST(GcodeControl, WordsBehindAnOWordAreRefused) {
  const std::pair<const char*, int> cases[] = {
      {"o1 if [1] G1 X9\no1 endif", 2},
      {"o1 if [1]\no1 endif G1 X9", 3},
      {"o1 if [0]\no1 else X9\no1 endif", 3},
      {"o1 if [0]\no1 elseif [1] X9\no1 endif", 3},
      {"o1 while [0] X9\no1 endwhile", 2},
      {"#1=0\no1 while [#1 LT 1]\n#1=1\no1 endwhile X9", 5},
      {"o1 do X9\no1 while [0]", 2},
      {"o1 do\no1 while [0] X9", 3},
      {"o1 repeat [1] X9\no1 endrepeat", 2},
      {"o1 repeat [1]\no1 endrepeat X9", 3},
      {"o1 repeat [1]\no1 break X9\no1 endrepeat", 3},
      {"o1 repeat [1]\no1 continue X9\no1 endrepeat", 3},
      {"o1 sub X9\no1 endsub", 2},
      {"o1 sub\no1 endsub X9\no1 call", 3},
      {"o1 sub\no1 return [3] X9\no1 endsub\no1 call", 3},
      {"o1 sub\no1 endsub\no1 call [1] F30", 4},
      {"o1 sub\no1 endsub\no1 call #4", 4},
      {"#1=0\no1 if #1 EQ 1\no1 endif", 3},
  };
  for (const auto& [text, at] : cases)
    EXPECT_EQ(fault_lines(std::string("G1 X1\n") + text + "\nX2"), (std::vector{at})) << text;
  // Comments may stand there.
  EXPECT_EQ(xs("o1 sub (a) ; b\nX#1\no1 endsub(c)\no1 call [5] (d) (e) ; f\no2 if [1];g\nX6\no2 endif (h)"),
            (List{5, 6}));
}

}  // namespace
}  // namespace bahnwerk
