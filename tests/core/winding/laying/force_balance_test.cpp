#include "core/winding/laying/force_balance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::winding {
namespace {

Progress silent;
constexpr std::size_t wall = ForceBalance::wall;

struct Contact {
  std::size_t wire, other;
  Point normal;
};
struct Pile {
  std::vector<Point> forces;
  std::vector<Contact> contacts;
};

ForceBalance built(const Pile& pile, double friction) {
  ForceBalance balance(friction);
  for (const Point f : pile.forces) balance.add_wire(f);
  for (const Contact& c : pile.contacts) balance.add_contact(c.wire, c.other, c.normal);
  return balance;
}

/// Directions in which a contact may push: its normal or both limits of its friction.
std::vector<Point> limits(const Contact& c, double friction) {
  if (friction == 0) return {c.normal};
  return {unit(c.normal + friction * left_of(c.normal)), unit(c.normal - friction * left_of(c.normal))};
}

/// The forces of a balance act as claimed, or its velocities prove the slip: work is done and no contact closes.
void expect_proof(const Pile& pile, double friction) {
  ForceBalance balance = built(pile, friction);
  const ForceBalance::Result result = balance.solve(silent);
  if (result.balanced) {
    std::vector<Point> sum = pile.forces;
    std::size_t k = 0;
    for (const Contact& c : pile.contacts)
      for (const Point d : limits(c, friction)) {
        const double push = balance.pushes()[k++];
        EXPECT_GE(push, 0);
        sum[c.wire] += push * d;
        if (c.other != wall) sum[c.other] -= push * d;
      }
    for (const Point left : sum) EXPECT_LT(norm(left), 1.1e-6);
    return;
  }
  EXPECT_TRUE(result.proves_slip());
  const auto v = balance.left();
  double work = 0, fastest = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    work += dot(v[i], pile.forces[i]);
    fastest = std::max(fastest, norm(v[i]));
  }
  EXPECT_GT(work, 0);
  EXPECT_NEAR(norm(v[result.fastest]), fastest, 1e-12);
  for (const Contact& c : pile.contacts)
    for (const Point d : limits(c, friction))
      EXPECT_GT(dot(c.other == wall ? v[c.wire] : v[c.wire] - v[c.other], d), -1e-6 * fastest);
}

TEST(ForceBalance, OneWireOnASlopeHoldsUpToItsFriction) {
  for (const double slope : {0.05, 0.3, 0.8}) {
    const Pile pile{{{0, -1}}, {{0, wall, {std::sin(slope), std::cos(slope)}}}};
    EXPECT_FALSE(built(pile, 0).solve(silent).balanced);
    EXPECT_TRUE(built(pile, std::tan(slope) + 1e-3).solve(silent).balanced);
    EXPECT_FALSE(built(pile, std::tan(slope) - 1e-3).solve(silent).balanced);
  }
}

TEST(ForceBalance, WedgeDrivesTwoWiresApart) {
  // Two wires on a base, one on both with contacts at 45°. Balance without moments needs tan(45° − φ)/2 ≤ 3/2 tan φ,
  // that is a friction of (√28 − 4)/6.
  const double s = std::sqrt(0.5);
  const Pile pile{{{0, -1}, {0, -1}, {0, -1}}, {{0, wall, {0, 1}}, {1, wall, {0, 1}}, {2, 0, {s, s}}, {2, 1, {-s, s}}}};
  const double limit = (std::sqrt(28) - 4) / 6;
  EXPECT_FALSE(built(pile, 0).solve(silent).balanced);
  EXPECT_FALSE(built(pile, limit - 1e-3).solve(silent).balanced);
  EXPECT_TRUE(built(pile, limit + 1e-3).solve(silent).balanced);
  Pile held = pile;
  held.contacts.push_back({0, wall, {1, 0}});
  held.contacts.push_back({1, wall, {-1, 0}});
  EXPECT_TRUE(built(held, 0).solve(silent).balanced);
}

TEST(ForceBalance, WireWithoutContactSlipsAlongItsForce) {
  ForceBalance balance = built({{{0.6, 0.8}}, {}}, 0.2);
  const auto result = balance.solve(silent);
  EXPECT_FALSE(result.balanced);
  EXPECT_EQ(result.closing, 0);
  EXPECT_EQ(balance.left()[0], (Point{0.6, 0.8}));
}

TEST(ForceBalance, WireWithoutForceRests) { EXPECT_TRUE(built({{{0, 0}}, {}}, 0).solve(silent).balanced); }

TEST(ForceBalance, LongColumnCarriesItsWeight) {
  Pile pile;
  for (std::size_t i = 0; i < 300; ++i) {
    pile.forces.push_back({0, -1});
    pile.contacts.push_back({i, i ? i - 1 : wall, {0, 1}});
  }
  ForceBalance balance = built(pile, 0);
  ASSERT_TRUE(balance.solve(silent).balanced);
  for (std::size_t i = 0; i < 300; ++i) EXPECT_NEAR(balance.pushes()[i], 300 - static_cast<double>(i), 1e-2);
}

TEST(ForceBalance, GrownPileGivesTheSameVerdictAsAWholeOne) {
  Random random(4);
  for (int round = 0; round < 60; ++round) {
    Pile pile;
    ForceBalance grown(0.2);
    bool balanced = true;
    for (std::size_t i = 0; i < 8; ++i) {
      pile.forces.push_back({random.uniform(-0.3, 0.3), -1});
      grown.add_wire(pile.forces.back());
      for (int k = 0; k < 2; ++k) {
        const double a = random.uniform(0.2, 2.9);
        const std::size_t other = i == 0 || random.chance(0.4) ? wall : random.below(i);
        pile.contacts.push_back({i, other, {std::cos(a), std::sin(a)}});
        grown.add_contact(i, other, pile.contacts.back().normal);
      }
      balanced = grown.solve(silent).balanced;
    }
    EXPECT_EQ(balanced, built(pile, 0.2).solve(silent).balanced);
  }
}

TEST(ForceBalance, VerdictsOfRandomPilesAreProved) {
  Random random(9);
  int balanced = 0;
  for (int round = 0; round < 400; ++round) {
    Pile pile;
    const std::size_t n = 1 + random.below(8);
    for (std::size_t i = 0; i < n; ++i) {
      pile.forces.push_back({random.uniform(-0.5, 0.5), random.uniform(-1, -0.2)});
      const int touching = 2 + static_cast<int>(random.below(3));
      for (int k = 0; k < touching; ++k) {
        const double a = random.uniform(0, 3.2);
        pile.contacts.push_back({i, i == 0 || random.chance(0.4) ? wall : random.below(i), {std::cos(a), std::sin(a)}});
      }
    }
    const double friction = round % 2 ? 0 : random.uniform(0, 0.6);
    expect_proof(pile, friction);
    balanced += built(pile, friction).solve(silent).balanced;
  }
  EXPECT_GT(balanced, 40);
  EXPECT_LT(balanced, 360);
}

}  // namespace
}  // namespace bahnwerk::winding
