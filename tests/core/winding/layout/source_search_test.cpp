/// The search for the most wires against that of the source, [Herrmann Algorithm 4.3]: four random starts per number of
/// wires, wires grown from half their radius, a balance of forces at the full one, success if no two overlap by more
/// than half the tolerance. Its counts depend on chance; the seed is fixed.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/layout/potential.hpp"
#include "core/winding/packing/overlap_energy.hpp"
#include "core/winding/slot/slot.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk::winding {
namespace {

double rule(const Wire& wire) { return 0.5 * wire.tolerance * wire.radius(); }

class FourStarts {
 public:
  FourStarts(const Region& slot, const Wire& wire, Random& random)
      : slot_(slot),
        wire_(wire),
        random_(random),
        usable_area_(slot, wire.radius(), silent_),
        energy_(usable_area_, 2 * wire.radius()) {
    places_ = usable_area_.spread(wire.radius() / 4);
  }
  std::size_t most() {
    const double area = std::numbers::pi * wire_.radius() * wire_.radius();
    auto count = static_cast<std::size_t>(0.72 * slot_.area() / area);  // (4.8)
    std::size_t best = 0;
    for (int failures = 0;;) {
      if (start(count)) {
        best = count++;
        failures = 0;
      } else if (++failures == 4) {
        if (best > 0) return best;
        --count;
        failures = 0;
      }
    }
  }

 private:
  bool start(std::size_t count) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    Progress silent;
    std::vector<Point> wires;
    for (std::size_t i = 0; i < count; ++i) wires.push_back(places_[random_.below(places_.size())]);
    for (int grown = 100; grown < 200; ++grown) {
      energy_.set_distance(2 * wire_.radius() * grown / 200);
      minimiser_.minimise(energy_, wires, endless, 30, silent);
    }
    energy_.set_distance(2 * wire_.radius());
    minimiser_.minimise(energy_, wires, endless, 3000, silent);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = i + 1; k < count; ++k)
        if (2 * wire_.radius() - distance(wires[i], wires[k]) > rule(wire_)) return false;
    return true;
  }

  const Region& slot_;
  Wire wire_;
  Random& random_;
  Progress silent_;
  CentreArea usable_area_;
  OverlapEnergy energy_;
  Minimiser minimiser_;
  std::vector<Point> places_;
};

TEST(SourceSearch, NeverFindsMoreWires) {
  const Slot slot = make_slot(StatorSlot{});
  Progress silent;
  const std::vector<Wire> wires = standard_wires(2, 0.63, 1.6, Series::r20);
  std::vector<std::size_t> most;
  for (const Wire& wire : wires) {
    PotentialOptions options;
    options.overlap = rule(wire);
    options.effort = 0.3;
    most.push_back(potential(slot.usable_area, wire.radius(), {}, options, silent).size());
  }
  Random random(1);
  for (std::size_t i = 0; i < wires.size(); ++i) {
    const std::size_t count = FourStarts(slot.usable_area, wires[i], random).most();
    EXPECT_LE(count, most[i]) << wires[i].copper;
    EXPECT_GE(static_cast<double>(count), 0.93 * static_cast<double>(most[i])) << wires[i].copper;
  }
}

/// 78 wires of 0.90 mm would be the largest electrical fill factor of the example slot. How little they can overlap:
/// found with much overlap, pressed together as they lie, searched for again with a little less. It is more than the
/// rule allows.
TEST(SourceSearch, SeventyEightWiresPressedTogether) {
  const Slot slot = make_slot(StatorSlot{});
  const Wire wire = *standard_wire(0.9, 2);
  const double r = wire.radius();
  Progress silent;
  double least = 0.025;  // of the radius
  std::vector<std::vector<Point>> best;
  const auto found = [&](double overlap, double effort) {
    PotentialOptions options;
    options.overlap = overlap * r;
    options.effort = effort;
    const auto wires = pack(slot.usable_area, r, 78, best, options, silent);
    if (!wires) return false;
    EXPECT_TRUE(packed(slot.usable_area, r, options.overlap, *wires));
    best = {*wires};
    least = overlap;
    return true;
  };
  ASSERT_TRUE(found(least, 0.5));
  do {
    for (double step = 3e-4; step > 5e-7;)
      if (!found(least - step, 1e-4)) step /= 2;
  } while (found(least - 3e-5, 0.5));
  EXPECT_LT(least, 0.0168);
  EXPECT_GT(least, rule(wire) / r);
}

}  // namespace
}  // namespace bahnwerk::winding
