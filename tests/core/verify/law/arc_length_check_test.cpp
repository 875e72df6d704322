// The length of a free-form curve against the way that a law says it goes.
#include "core/verify/law/arc_length_check.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/base/progress.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk::verify {
namespace {

struct ArcLength : testing::Test {
  Path path;
  Progress progress;
  ProgressScope stage_progress{progress, ""};
  void SetUp() override {
    path.append(std::make_shared<Rational>(Rational::from_power_basis({{0, 40, -30, 25}, {0, -5, 60, -20}})), 0);
  }
  LawPiece whole() const {
    LawPiece piece;
    piece.s_end = path.length();
    return piece;
  }
  bool passed(const ArcLengthCheck& check) const { return check.worst().value <= check.worst().limit; }
};

TEST_F(ArcLength, AWayAsLongAsTheCurveIsBelieved) {
  ArcLengthCheck check(stage_progress);
  check.believe(whole(), path[0], path.length());
  check.measure(whole(), path[0], 0, 1, 0, path.length());
  EXPECT_TRUE(passed(check)) << check.worst().value << " against " << check.worst().limit;
  EXPECT_LE(check.worst().limit, 1e-8);
}

TEST_F(ArcLength, AWayThatIsALittleTooLongIsNot) {
  for (const double factor : {1 + 1e-9, 1 - 1e-9, 1.5}) {
    ArcLengthCheck believed(stage_progress), measured(stage_progress);
    believed.believe(whole(), path[0], factor * path.length());
    measured.measure(whole(), path[0], 0, 1, 0, factor * path.length());
    EXPECT_FALSE(passed(believed)) << factor;
    EXPECT_FALSE(passed(measured)) << factor;
  }
}

TEST_F(ArcLength, AnEmptyStretchSaysNothing) {
  ArcLengthCheck check(stage_progress);
  check.measure(whole(), path[0], 0.5, 0.5, 1, 2);
  EXPECT_EQ(check.worst().value, 0);
}

}  // namespace
}  // namespace bahnwerk::verify
