#include "core/verify/cam/textbook_laws.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::verify {
namespace {

TEST(TextbookLaws, BeginAndEndAtRestAndPassTheirInflection) {
  for (const auto& entry : cam::classical_laws) {
    if (entry.value == cam::ClassicalLaw::double_harmonic_from_dwell ||
        entry.value == cam::ClassicalLaw::double_harmonic_to_dwell)
      continue;  // not symmetric
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

}  // namespace
}  // namespace bahnwerk::verify
