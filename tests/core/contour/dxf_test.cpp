#include "core/contour/dxf.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/numeric/random.hpp"
#include "dxf_text.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk {
namespace {

using namespace test;
constexpr double pi = std::numbers::pi;

/// Every block is without a jump, and between blocks there is none either.
void expect_continuous(const Contour& c) {
  for (std::size_t i = 1; i < c.path.size(); ++i) {
    const Segment &a = c.path[i - 1], &b = c.path[i];
    EXPECT_LT(norm(a.curve().at(a.curve().end()).value - b.curve().at(b.curve().begin()).value), 1e-9) << i;
  }
}

TEST(Dxf, LooseLinesAndArcsBecomeOneClosedBlock) {
  // A slot, its four parts in any order and direction.
  const Contour c =
      read([](DxfText& t) { t.arc(20, 0, 5, 270, 90).line(0, 5, 20, 5).line(0, -5, 20, -5).arc(0, 0, 5, 90, 270); });
  ASSERT_EQ(c.blocks.size(), 1u);
  EXPECT_EQ(c.path.size(), 4u);
  EXPECT_NEAR(c.path.length(), 40 + 10 * pi, 1e-12);
  EXPECT_LT(norm(begin_of(c) - Vec{20, -5, 0}), 1e-12);  // starts as the first entity does
  EXPECT_LT(norm(end_of(c) - begin_of(c)), 1e-12);
  for (const Joint& j : joints(c.path)) EXPECT_LT(j.angle, 1e-12);
}

TEST(Dxf, BlocksInTheOrderDrawnWithPositioningBetween) {
  DxfOptions options;
  options.feed = 50;
  const Contour c = read([](DxfText& t) { t.circle(0, 0, 5).circle(100, 0, 5).circle(20, 0, 5); }, options);
  ASSERT_EQ(c.blocks.size(), 5u);
  EXPECT_EQ(c.blocks[0].feed, 50);
  EXPECT_EQ(c.blocks[1].mode, Mode::position);
  EXPECT_TRUE(std::isinf(c.blocks[1].feed));
  EXPECT_NEAR(c.path.length() - cut_length(c), 100 + 80, 1e-12);
  options.order = DxfOrder::nearest;
  const Contour n = read([](DxfText& t) { t.circle(0, 0, 5).circle(100, 0, 5).circle(20, 0, 5); }, options);
  EXPECT_NEAR(n.path.length() - cut_length(n), 20 + 80, 1e-12);
}

TEST(Dxf, NearestOrderReversesOpenBlocksAndTurnsClosedOnes) {
  DxfOptions options;
  options.order = DxfOrder::nearest;
  const Contour c = read(
      [](DxfText& t) {
        t.line(0, 0, 10, 0);
        t.polyline({{{30, 0, 0}}, {{40, 0, 0}}, {{40, 10, 0}}, {{30, 10, 0}}}, true);
        t.polyline({{{0, 20, 0.5}}, {{20, 20, -0.3}}, {{20, 1, 0}}}, false);
      },
      options);
  // Line to (10, 0); polyline backwards from (20, 1) to (0, 20); square from its corner (30, 10).
  EXPECT_NEAR(c.path.length() - cut_length(c), std::hypot(10, 1) + std::hypot(30, 10), 1e-12);
  EXPECT_LT(norm(end_of(c) - Vec{30, 10, 0}), 1e-12);
  expect_continuous(c);
}

TEST(Dxf, DuplicatesInEitherDirectionAreDropped) {
  const Contour c = read([](DxfText& t) {
    t.line(0, 0, 10, 0).line(10, 0, 0, 0).line(0, 0, 10, 0).circle(0, 30, 5).circle(0, 30, 5).circle(0, 30, 4);
    t.arc(50, 0, 5, 0, 90).arc(50, 0, 5, 0, 91);
    t.polyline({{{0, 50, 1}}, {{10, 50, 0}}, {{10, 60, 0}}}, false);
    t.polyline({{{10, 60, 0}}, {{10, 50, -1}}, {{0, 50, 0}}}, false);
  });
  EXPECT_TRUE(noted(c, "dropped: 4 entities drawn a second time"));
  EXPECT_NEAR(cut_length(c), 10 + 10 * pi + 8 * pi + 5 * pi * 181 / 180 + 5 * pi + 10, 1e-9);
}

TEST(Dxf, GapsWithinTheToleranceAreClosed) {
  for (const double gap : {1e-9, 1e-7, 5e-4, 0.009}) {
    const Contour c = read([&](DxfText& t) {
      t.line(0, 0, 20, 0).arc(20 + gap, 5, 5, 270, 90).line(20, 10, 0, 10).arc(0, 5, 5, 90, 270);
    });
    EXPECT_EQ(cut_count(c), 1u) << gap;
    EXPECT_EQ(c.path.size(), 4u) << gap;
    EXPECT_NEAR(c.path.length(), 40 + 10 * pi, 5 * gap + 1e-9);
    EXPECT_LT(norm(begin_of(c) - end_of(c)), 1e-9);
    EXPECT_EQ(noted(c, "gap"), gap > 1e-6);
    expect_continuous(c);
  }
  EXPECT_EQ(cut_count(read([](DxfText& t) { t.line(0, 0, 10, 0).line(10.02, 0, 20, 0); })), 2u);
}

TEST(Dxf, CurvesTooShortToBeMovedGetAShortLine) {
  const Contour c = read([](DxfText& t) { t.arc(0, 0, 0.05, 180, 0).arc(0.109, 0, 0.05, 180, 0); });
  EXPECT_EQ(cut_count(c), 1u);
  EXPECT_EQ(c.path.size(), 3u);
  EXPECT_NEAR(c.path.length(), 0.1 * pi + 0.009, 1e-9);
  EXPECT_TRUE(noted(c, "1 of them by a short line"));
}

TEST(Dxf, SplineEndsMoveInProportion) {
  const Contour c = read([](DxfText& t) {
    t.line(0, 0, 10, 0);
    t.tag(0, "SPLINE", 8, "0", 71, 3);
    for (const int k : {0, 0, 0, 0, 1, 1, 1, 1}) t.tag(40, k);
    t.tag(10, 10, 20, 0.005, 10, 15, 20, 0, 10, 20, 20, 5, 10, 20, 20, 10);
    t.tag(0, "ELLIPSE", 8, "0", 10, 20, 20, 20.004, 11, 0, 21, 10, 40, 0.5, 41, 0, 42, pi);
  });
  ASSERT_EQ(cut_count(c), 1u);
  expect_continuous(c);
  EXPECT_LT(norm(c.path[1].at(c.path[1].s0()).value - Vec{10, 0, 0}), 1e-12);
  EXPECT_EQ(noted(c, "2 gaps"), true);
}

TEST(Dxf, AlmostClosedArcsKeepTheirShapeWhenAnEndMoves) {
  const Contour c = read([](DxfText& t) { t.line(20, 0, 10, 0.004).arc(0, 0, 10, 0, 359.9); });
  ASSERT_EQ(cut_count(c), 1u);
  for (int i = 0; i <= 100; ++i) {
    const double s = c.path.length() - 62.7 * i / 100;
    EXPECT_NEAR(norm(c.path.at(s).value), 10, 0.01);
  }
  expect_continuous(c);
}

TEST(Dxf, ChordsShorterThanTheToleranceStayInOrder) {
  // A circle of 0.004 mm chords as single lines, in mixed order.
  const int n = 3000;
  const double r = 2;
  const auto at = [&](int i) { return Vec{r * std::cos(2 * pi * i / n), r * std::sin(2 * pi * i / n), 0}; };
  const Contour c = read([&](DxfText& t) {
    for (int k = 0; k < n; ++k) {
      const int i = k * 1117 % n;
      const Vec p = at(i), q = at(i + 1);
      t.line(p.x, p.y, q.x, q.y);
    }
  });
  EXPECT_EQ(c.blocks.size(), 1u);
  EXPECT_EQ(c.path.size(), 3000u);
  EXPECT_NEAR(c.path.length(), n * 2 * r * std::sin(pi / n), 1e-9);
}

TEST(Dxf, OptionsAreChecked) {
  const std::string text = drawing([](DxfText& t) { t.line(0, 0, 1, 0); });
  DxfOptions options;
  options.tolerance = -1;
  options.feed = 0;
  options.millimetres_per_unit = HUGE_VAL;
  EXPECT_EQ(faults(text, options).size(), 3u);
}

TEST(Dxf, SameTextSameContour) {
  const auto make = [] {
    return read([](DxfText& t) {
      Random random(7);
      for (int i = 0; i < 300; ++i)
        t.line(std::floor(random.uniform(0, 10)), std::floor(random.uniform(0, 10)), std::floor(random.uniform(0, 10)),
               std::floor(random.uniform(0, 10)));
    });
  };
  const Contour a = make(), b = make();
  ASSERT_EQ(a.path.size(), b.path.size());
  EXPECT_EQ(a.path.length(), b.path.length());
  expect_continuous(a);
}

/// Progress that gives up at the n-th call.
class Stopping final : public ProgressSink {
 public:
  explicit Stopping(int calls) : left_(calls) {}
  void report(std::string_view, double, std::string_view) override {
    if (--left_ < 0) throw Stopped(StopReason::cancelled);
  }
  int left() const { return left_; }

 private:
  int left_;
};

TEST(Dxf, CanBeStoppedAnywhere) {
  const std::string text = drawing([](DxfText& t) {
    for (int i = 0; i < 5000; ++i) t.line(i, 0, i, 1);
    t.tag(0, "SPLINE", 8, "0", 71, 3);
    for (int i = 0; i < 3004; ++i) t.tag(40, i);
    for (int i = 0; i < 3000; ++i) t.tag(10, i, 20, i % 7);
  });
  DxfOptions options;
  options.order = DxfOrder::nearest;
  Stopping never(1000);
  read_dxf(text, options, never);
  const int calls = 1000 - never.left();
  EXPECT_GT(calls, 5);
  for (int i = 0; i < calls; ++i) {
    Stopping stopping(i);
    EXPECT_THROW(read_dxf(text, options, stopping), Stopped) << i;
  }
}

TEST(Dxf, LongSplinesStayWhole) {
  // More spans than are handed over at once; double and triple knots in between.
  std::vector<Vec> points;
  std::vector<double> knots{0, 0, 0, 0};
  for (int i = 0; i < 2000; ++i) points.push_back({0.1 * i, std::sin(0.05 * i), 0});
  for (int i = 4; i < 2000; ++i)
    knots.push_back(i % 5 == 0 || i % 7 == 0 ? knots.back() + 1 : knots.back() + (i % 3 > 0));
  knots.insert(knots.end(), 4, knots.back() + 1);
  const Contour c = read([&](DxfText& t) {
    t.tag(0, "SPLINE", 8, "0", 71, 3);
    for (const double k : knots) t.tag(40, k);
    for (const Vec& p : points) t.tag(10, p.x, 20, p.y);
  });
  ContourBuilder builder(2, points.front());
  builder.nurbs(3, points, {}, knots);
  const Contour whole = builder.finish();
  ASSERT_EQ(c.path.size(), whole.path.size());
  EXPECT_NEAR(c.path.length(), whole.path.length(), 1e-9);
  for (int i = 0; i <= 300; ++i) {
    const double s = whole.path.length() * i / 300;
    EXPECT_LT(norm(c.path.at(s).value - whole.path.at(s).value), 1e-9);
  }
}

std::string rich_drawing() {
  DxfText t;
  t.unit(1).section("TABLES").tag(0, "TABLE", 2, "LAYER", 70, 1);
  t.tag(0, "LAYER", 2, "cold", 70, 1, 62, 7, 0, "ENDTAB").end();
  t.section("BLOCKS").tag(0, "BLOCK", 8, "0", 2, "b", 70, 0, 10, 1, 20, 2).arc(0, 0, 1, 10, 200).tag(0, "ENDBLK");
  t.tag(0, "BLOCK", 8, "0", 2, "c", 10, 0, 20, 0);
  t.tag(0, "INSERT", 8, "0", 2, "b", 10, 3, 41, 2, 42, -1, 50, 30, 70, 2, 71, 2, 44, 5, 45, 6).tag(0, "ENDBLK").end();
  t.section("ENTITIES").line(0, 0, 1, 0).line(1, 0, 1, 1).circle(5, 5, 1).arc(1, 2, 1, 270, 0);
  t.polyline({{{0, 0, 1}}, {{3, 0, -0.4}}, {{3, 3, 0}}}, true);
  t.tag(0, "POLYLINE", 66, 1, 70, 1).tag(0, "VERTEX", 10, 0, 20, 9, 42, 0.2).tag(0, "VERTEX", 10, 4, 20, 9);
  t.tag(0, "VERTEX", 10, 4, 20, 12).tag(0, "SEQEND");
  t.tag(0, "ELLIPSE", 10, 0, 20, 0, 11, 4, 21, 1, 40, 0.5, 41, 0.3, 42, 5, 230, -1);
  t.tag(0, "SPLINE", 70, 0, 71, 2, 40, 0, 40, 0, 40, 0, 40, 1, 40, 2, 40, 2, 40, 2);
  t.tag(41, 1, 41, 2, 41, 1, 41, 1, 10, 0, 20, 0, 10, 1, 20, 1, 10, 2, 20, 0, 10, 3, 20, 1);
  t.tag(0, "SPLINE", 70, 1, 71, 3, 11, 0, 21, 0, 11, 1, 21, 1, 11, 2, 21, 0, 11, 1, 21, -2);
  t.tag(0, "INSERT", 8, "x", 2, "c", 10, 1, 20, 1, 230, -1).tag(0, "TEXT", 1, "hello").end();
  return t.eof();
}

TEST(Dxf, MutatedFilesAreReadOrRefused) {
  const std::string text = rich_drawing();
  DxfOptions options;
  options.max_curves = 2'000;
  ASSERT_TRUE(faults(text, options).empty());
  Random random(20261121);
  const std::string alphabet = "0123456789.-+eE \n\r\tANBINSRT";
  const std::vector<std::string> words{"1e308", "-1e-308", "nan", "2147483647", "0", "INSERT", "ENDSEC", "1e9", "210"};
  std::vector<std::size_t> starts{0};  // of lines
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '\n') starts.push_back(i + 1);
  std::size_t refused = 0;
  for (int round = 0; round < testing::cases(20'000); ++round) {
    std::string mutated = text;
    for (std::uint64_t k = 1 + random.below(3); k > 0; --k) {
      const auto at = static_cast<std::size_t>(random.below(mutated.size()));
      switch (random.below(5)) {
        case 0:
          mutated[at] = alphabet[random.below(alphabet.size())];
          break;
        case 1:
          mutated.erase(at, 1 + random.below(12));
          break;
        case 2:
          mutated.insert(at, text.substr(starts[random.below(starts.size())], random.below(60)));
          break;
        case 3:
          mutated[at] = static_cast<char>(random.below(256));
          break;
        default: {
          const std::size_t from = starts[random.below(starts.size())];
          if (from < mutated.size())
            mutated.replace(from, std::min(mutated.find('\n', from), mutated.size()) - from,
                            words[random.below(words.size())]);
        }
      }
    }
    try {
      options.order = round % 2 == 0 ? DxfOrder::as_drawn : DxfOrder::nearest;
      const Contour c = read_dxf(mutated, options);
      ASSERT_GT(c.path.length(), 0);
    } catch (const InvalidInput& e) {
      ++refused;
      ASSERT_FALSE(e.faults.empty());
      for (const InputFault& f : e.faults) {
        ASSERT_EQ(f.place, (std::vector<std::string>{"contour", "dxf"})) << f.message;
        ASSERT_EQ(f.message.rfind("line ", 0), 0u) << f.message;
      }
    }
  }
  // Both have to occur, or the mutations say nothing.
  EXPECT_GT(4 * refused, testing::cases(20'000u));
  EXPECT_LT(20 * refused, 19 * testing::cases(20'000u));
}

}  // namespace
}  // namespace bahnwerk
