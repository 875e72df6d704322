#include "core/plan/fill_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk {
namespace {

using winding::Algorithm;

FillRequest stator(std::vector<double> copper) {
  FillRequest request;
  request.slot = make_slot(winding::StatorSlot{});
  for (const double d : copper) request.wires.push_back(*winding::standard_wire(d, 2));
  request.algorithms = {Algorithm::orthocyclic_base, Algorithm::orthocyclic_flank, Algorithm::raabe,
                        Algorithm::potential, Algorithm::needle};
  request.tie_in = request.slot.tension_point;
  request.heads = winding::StatorHeads{};
  return request;
}

const FilledLayout& of(const FillPlan& plan, Algorithm algorithm, std::size_t wire = 0) {
  std::size_t seen = 0;
  for (const FilledLayout& filled : plan.layouts)
    if (filled.algorithm == algorithm && seen++ == wire) return filled;
  throw std::logic_error("no such layout");
}

/// Whether progress never goes back and the planner stops where it is told to.
class Watch final : public ProgressSink {
 public:
  explicit Watch(double stop = 2) : stop_(stop) {}
  void report(std::string_view stage, double fraction, std::string_view) override {
    EXPECT_GE(fraction, last_ - 1e-12) << stage;
    EXPECT_LE(fraction, 1 + 1e-12);
    last_ = fraction;
    stages.insert(std::string(stage));
    if (fraction >= stop_) throw Stopped(StopReason::cancelled);
  }
  std::set<std::string> stages;

 private:
  double stop_, last_ = 0;
};

TEST(FillPlan, OrderingsOfTheSource) {
  Watch watch;
  const FillPlan plan = plan_fill(stator({0.63, 0.9, 1.25}), watch);
  EXPECT_TRUE(plan.verification.passed);
  for (std::size_t i = 0; i < 3; ++i) {
    const FilledLayout& most = of(plan, Algorithm::potential, i);
    for (const auto other :
         {Algorithm::orthocyclic_base, Algorithm::orthocyclic_flank, Algorithm::raabe, Algorithm::needle})
      EXPECT_GT(most.count(), of(plan, other, i).count());
    EXPECT_LE(most.count(), most.bound);
    // [Herrmann 4.2.3]: which of the layouts can be wound.
    EXPECT_FALSE(most.windable.producible.producible());
    EXPECT_FALSE(of(plan, Algorithm::orthocyclic_base, i).windable.producible.producible());
    EXPECT_FALSE(of(plan, Algorithm::orthocyclic_flank, i).windable.producible.producible());
    EXPECT_TRUE(of(plan, Algorithm::needle, i).windable.producible.producible());
  }
  EXPECT_GT(of(plan, Algorithm::needle, 0).mechanical, of(plan, Algorithm::needle, 2).mechanical);
  EXPECT_TRUE(watch.stages.count("potential, 0.9 mm"));
}

TEST(FillPlan, TheSearchKeepsTheAllowedOverlap) {
  FillRequest request = stator({1.0});
  request.algorithms = {Algorithm::potential};
  Progress silent;
  const FillPlan source = plan_fill(request, silent);
  const winding::Wire& wire = request.wires.front();
  EXPECT_NEAR(source.layouts[0].overlap, 0.5 * wire.tolerance * wire.radius(), 1e-15);
  EXPECT_LE(source.layouts[0].overlaps.deepest, source.layouts[0].overlap + 1e-9);
  request.overlap_tolerance = 0;
  const FillPlan exact = plan_fill(request, silent);
  EXPECT_LE(exact.layouts[0].overlaps.deepest, 1e-9);
  EXPECT_LE(exact.layouts[0].count(), source.layouts[0].count());
}

TEST(FillPlan, SameRequestSameBits) {
  FillRequest request = stator({1.6});
  request.sampling = {2, std::nullopt, 0.05};
  Progress silent;
  const FillPlan a = plan_fill(request, silent), b = plan_fill(request, silent);
  for (std::size_t i = 0; i < a.layouts.size(); ++i) {
    EXPECT_EQ(a.layouts[i].layout.wires, b.layouts[i].layout.wires);
    EXPECT_EQ(a.layouts[i].sampled, b.layouts[i].sampled);
  }
}

TEST(FillPlan, ExpectedTimeGrowsWithWhatIsAskedFor) {
  FillRequest request = stator({0.9});
  const double one = expected_time(request);
  EXPECT_GT(one, 0.2);
  EXPECT_LT(one, 3);
  request.effort = 100;
  EXPECT_GT(expected_time(request), 50 * one);
  request.effort = 1;
  request.sampling.samples = 99;
  EXPECT_GT(expected_time(request), 90 * one);
  request = stator({0.9, 0.95});
  EXPECT_GT(expected_time(request), 1.7 * one);
  request.algorithms = {Algorithm::needle};
  EXPECT_LT(expected_time(request), 0.1);
  request.wires.clear();
  EXPECT_EQ(expected_time(request), 0);
}

TEST(FillPlan, SamplesSpreadAroundTheNominalCount) {
  FillRequest request = stator({0.9});
  request.algorithms = {Algorithm::needle};
  request.sampling = {40, 0.04, 0.1};
  Progress silent;
  const FillPlan plan = plan_fill(request, silent);
  const FilledLayout& filled = plan.layouts[0];
  ASSERT_EQ(filled.sampled.size(), 40u);
  const auto [least, most] = std::minmax_element(filled.sampled.begin(), filled.sampled.end());
  EXPECT_LT(*least, *most);
  EXPECT_GT(*most, filled.count()) << "thinner wires in a wider slot";
  request.sampling = {5, 0.0, 0};
  const FillPlan exact = plan_fill(request, silent);
  for (const std::size_t count : exact.layouts[0].sampled) EXPECT_EQ(count, filled.count());
}

TEST(FillPlan, TellsWhatDoesNotPassTheOpening) {
  FillRequest request = stator({0.9});
  request.algorithms = {Algorithm::needle};
  request.needle = winding::Needle{2.6};
  Progress silent;
  EXPECT_TRUE(plan_fill(request, silent).layouts[0].can_be_wound()) << "as in the source";
  request.needle = winding::Needle{3.1};
  const FillPlan wide = plan_fill(request, silent);
  ASSERT_EQ(wide.layouts[0].windable.blocked.size(), 1u);
  EXPECT_EQ(wide.layouts[0].windable.blocked[0].part, winding::Obstruction::Part::needle);
  EXPECT_TRUE(wide.layouts[0].windable.producible.producible()) << "the pile itself would hold";
  winding::StatorSlot narrow;
  narrow.opening_width = narrow.wedge_width = 0.62;
  request.slot = make_slot(narrow);
  request.needle.reset();
  const FillPlan thin = plan_fill(request, silent);
  ASSERT_EQ(thin.layouts[0].windable.blocked.size(), 1u);
  EXPECT_EQ(thin.layouts[0].windable.blocked[0].part, winding::Obstruction::Part::wire);
  EXPECT_NEAR(thin.layouts[0].windable.blocked[0].clear, 0.02, 1e-12);
}

TEST(FillPlan, TurnsThatNoLayoutTakesAreInfeasible) {
  FillRequest request = stator({0.9, 1.6});
  request.algorithms = {Algorithm::needle};
  Progress silent;
  request.serial = 40;
  const FillPlan plan = plan_fill(request, silent);
  EXPECT_TRUE(plan.layouts[0].turns.fits);
  EXPECT_FALSE(plan.layouts[1].turns.fits) << "the thick wire";
  request.serial = 75;
  EXPECT_THROW(plan_fill(request, silent), Infeasible);
}

TEST(FillPlan, StopsWhereItIsTold) {
  Watch watch(0.3);
  EXPECT_THROW(plan_fill(stator({0.9, 1.0}), watch), Stopped);
}

TEST(FillPlan, AWireThatDoesNotFitIsNoFault) {
  FillRequest request = stator({1.0});
  request.wires.push_back({6, 6.2, 0.03});
  Progress silent;
  const FillPlan plan = plan_fill(request, silent);
  EXPECT_TRUE(plan.verification.passed);
  for (std::size_t i = 5; i < 10; ++i) EXPECT_EQ(plan.layouts[i].count(), 0u);
}

}  // namespace
}  // namespace bahnwerk
