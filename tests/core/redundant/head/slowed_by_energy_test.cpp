#include "core/redundant/head/slowed_by_energy.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

/// So many moves of a second each, from rest to rest.
TimeLaw moves(int count) {
  TimeLaw law;
  for (int i = 0; i < count; ++i)
    for (const bool braking : {false, true}) {
      LawPiece p;
      p.segment = static_cast<std::size_t>(i);
      p.s = i + (braking ? 0.5 : 0.0), p.s_end = p.s + 0.5, p.duration = 0.5;
      p.v = braking ? 2 : 0, p.a = braking ? -4 : 4;
      law.append(p);
    }
  return law;
}

double lasts(const TimeLaw& law, const std::vector<TimeLaw::Slowing>& slowings) {
  TimeLaw slow = law;
  slow.slow_sections(slowings);
  return slow.duration();
}

TEST(SlowedByEnergy, TwiceAsLongForSixteenTimesTheEnergy) {
  const TimeLaw law = moves(2);
  const auto [found, energy] = slowed_by_energy(law, {0, 0.5, 1, 1.5, 2}, {8, 8, 0.5, 0.5}, 3);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].factor, 2, 1e-9);
  EXPECT_NEAR(found[1].factor, 1, 1e-9);
  EXPECT_NEAR(lasts(law, found), 3, 1e-9);
  EXPECT_NEAR(energy, (16 / 8.0 + 1) / (17 / 1.5 / 1.5 / 1.5), 1e-9);
}

TEST(SlowedByEnergy, IsTheLeastEnergy) {
  const TimeLaw law = moves(3);
  const std::vector<double> energies{5, 1, 0.2};
  const auto energy = [&](double a, double b, double c) {
    return energies[0] / (a * a * a) + energies[1] / (b * b * b) + energies[2] / (c * c * c);
  };
  const auto found = slowed_by_energy(law, {0, 1, 2, 3}, energies, 3.9).slowings;
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(lasts(law, found), 3.9, 1e-9);
  const double least = energy(found[0].factor, found[1].factor, found[2].factor);
  for (double a = 1; a <= 1.9; a += 0.01)
    for (double b = 1; a + b <= 2.9; b += 0.01) EXPECT_GE(energy(a, b, 3.9 - a - b), least * (1 - 1e-9));
}

TEST(SlowedByEnergy, WhereNothingAcceleratesNothingIsSlowed) {
  const SlowedByEnergy found = slowed_by_energy(moves(2), {0, 1, 2}, {0, 0}, 3);
  EXPECT_TRUE(found.slowings.empty());
  EXPECT_EQ(found.energy, 1);
}

TEST(SlowedByEnergy, NoPartLastsMoreThanSixteenTimesAsLong) {
  const auto found = slowed_by_energy(moves(2), {0, 1, 2}, {1, 0}, 100).slowings;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].factor, 16, 1e-9);
  EXPECT_EQ(found[1].factor, 1);
}

}  // namespace
}  // namespace bahnwerk
