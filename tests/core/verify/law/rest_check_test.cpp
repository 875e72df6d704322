#include "core/verify/law/rest_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"

namespace bahnwerk {
namespace {

/// Three lines of 10 mm along x; each is driven in 2 s from rest to rest, and `rests` s pass at each place between.
Contour contour() {
  ContourBuilder b(2, {});
  b.line({10, 0, 0});
  b.line({20, 0, 0});
  b.line({30, 0, 0});
  return b.finish();
}
void drive(TimeLaw& law, std::size_t segment) {
  const double s = 10.0 * static_cast<double>(segment);
  law.append({0, 1, s, s + 5, 0, 10, 0, segment});
  law.append({0, 1, s + 5, s + 10, 10, -10, 0, segment});
}
void rest(TimeLaw& law, std::size_t segment, double seconds) {
  const double s = 10.0 * static_cast<double>(segment);
  law.append({0, seconds, s, s, 0, 0, 0, std::min<std::size_t>(segment, 2)});
}
TimeLaw law(double begin, double first, double second, double end) {
  TimeLaw law;
  const double seconds[] = {begin, first, second, end};
  for (std::size_t i = 0; i < 4; ++i) {
    if (seconds[i] > 0) rest(law, i, seconds[i]);
    if (i < 3) drive(law, i);
  }
  return law;
}

Check rests(const Contour& given, const Contour& driven, const TimeLaw& law) {
  Progress progress;
  return rest_check(given, driven, law, progress);
}

TEST(RestCheck, PassesWhatRestsLongEnough) {
  Contour c = contour();
  c.rests = {{0, 0.5, 0}, {1, 1, 0}, {1, 2, 0}, {2, 0, 0}, {3, 0.25, 0}};
  EXPECT_TRUE(rests(c, c, law(0.5, 3, 0, 0.25)).passed);
  EXPECT_TRUE(rests(c, c, law(0.6, 3.1, 1, 0.25)).passed);
  TimeLaw divided;  // in two parts
  rest(divided, 0, 0.5);
  drive(divided, 0);
  rest(divided, 1, 1);
  rest(divided, 1, 2);
  drive(divided, 1);
  drive(divided, 2);
  rest(divided, 3, 0.25);
  EXPECT_TRUE(rests(c, c, divided).passed);
}

TEST(RestCheck, FindsRestsThatAreTooShort) {
  Contour c = contour();
  c.rests = {{0, 0.5, 0}, {1, 3, 0}, {3, 0.25, 0}};
  const Check first = rests(c, c, law(0.499, 3, 0, 0.25));
  EXPECT_FALSE(first.passed);
  EXPECT_NEAR(first.value, 0.001, 1e-12);
  EXPECT_EQ(first.at, 0);
  const Check middle = rests(c, c, law(0.5, 2.9999, 5, 5));
  EXPECT_FALSE(middle.passed);
  EXPECT_NEAR(middle.value, 0.0001, 1e-12);
  EXPECT_NEAR(middle.at, 2.5, 1e-12);
  EXPECT_FALSE(rests(c, c, law(0.5, 3, 0, 0.2)).passed);
  EXPECT_FALSE(rests(c, c, law(0.5, 3, 0, 0)).passed);
}

TEST(RestCheck, FindsStopsThatAreNotMade) {
  Contour c = contour();
  c.rests = {{1, 0, 0}};
  TimeLaw through;  // at 10 mm/s, without a stop
  for (std::size_t i = 0; i < 3; ++i)
    through.append({0, 1, 10.0 * static_cast<double>(i), 10.0 * static_cast<double>(i + 1), 10, 0, 0, i});
  const Check check = rests(c, c, through);
  EXPECT_FALSE(check.passed);
  EXPECT_TRUE(std::isinf(check.value));
  EXPECT_TRUE(rests(c, c, law(0, 0, 0, 0)).passed);
  EXPECT_FALSE(rests(c, c, TimeLaw()).passed);
}

TEST(RestCheck, TheRestHasToBeAtItsPlace) {
  Contour given = contour();
  given.rests = {{1, 1, 0}};
  ContourBuilder aside(2, {});
  aside.line({10, 1e-5, 0});
  aside.line({20, 0, 0});
  aside.line({30, 0, 0});
  EXPECT_FALSE(rests(given, aside.finish(), law(0, 1, 0, 0)).passed);
  EXPECT_FALSE(rests(given, given, law(0, 0, 1, 0)).passed);
  given.rests = {{2, 1, 0}, {2, 1, 0}};
  EXPECT_FALSE(rests(given, given, law(0, 2, 1, 0)).passed);
  EXPECT_TRUE(rests(given, given, law(0, 2, 2, 0)).passed);
}

}  // namespace
}  // namespace bahnwerk
