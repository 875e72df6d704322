#include "core/verify/cam/textbook_laws.hpp"

#include <gtest/gtest.h>

#include "core/cam/classical/half_law.hpp"

namespace bahnwerk::verify {
namespace {

TEST(TextbookLaws, BeginAndEndAtRestAndPassTheirInflection) {
  for (const auto& entry : cam::classical_laws) {
    if (!cam::whole_law(entry.value).empty()) continue;  // not symmetric
    for (const double inflection : {0.5, 0.3}) {
      EXPECT_NEAR(textbook_law(entry.value, 0, inflection), 0, 1e-15) << entry.name;
      EXPECT_NEAR(textbook_law(entry.value, 1, inflection), 1, 1e-15) << entry.name;
      EXPECT_NEAR(textbook_law(entry.value, inflection, inflection), inflection, 1e-14) << entry.name;
      if (entry.value == cam::ClassicalLaw::straight) continue;
      EXPECT_NEAR(textbook_law(entry.value, 1e-6, inflection), 0, 1e-10) << entry.name;
      // No jump anywhere.
      for (double z = 0; z < 1; z += 1.0 / 4096)
        EXPECT_LT(textbook_law(entry.value, z + 1.0 / 4096, inflection) - textbook_law(entry.value, z, inflection),
                  3.0 / 4096);
    }
  }
}

TEST(TextbookLaws, LawsBetweenDwellAndReversalRestAtBothEnds) {
  for (const auto& entry : cam::classical_laws) {
    if (cam::whole_law(entry.value).empty()) continue;
    for (const double end : {0.0, 1.0}) {
      EXPECT_NEAR(textbook_law(entry.value, end, {}), end, 1e-15) << entry.name;
      EXPECT_NEAR(textbook_law(entry.value, std::abs(end - 1e-6), {}), end, 1e-10) << entry.name;
    }
  }
}

TEST(TextbookLaws, AnSccaWithAStraightPartIsStraightThere) {
  const cam::SineStraight half{0.125, 0.25, 0.125};  // a half of the section has constant velocity, Cv = 4/3
  for (const double z : {0.3, 0.5, 0.7})
    EXPECT_NEAR(textbook_law(cam::ClassicalLaw::sine_straight_combination, z, {}, half), 0.5 + 4.0 / 3 * (z - 0.5),
                1e-15);
}

}  // namespace
}  // namespace bahnwerk::verify
