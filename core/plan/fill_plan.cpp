#include "core/plan/fill_plan.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/verify/layout_verifier.hpp"
#include "core/winding/layout/count_bound.hpp"
#include "core/winding/layout/orthocyclic.hpp"
#include "core/winding/layout/potential.hpp"
#include "core/winding/layout/raabe.hpp"

namespace bahnwerk {
namespace {

using winding::Algorithm;
using winding::Layout;
using winding::Wire;

winding::LayingRegions regions_of(const FillRequest& request) {
  winding::LayingRegions regions =
      std::visit([&](const auto& heads) { return laying_regions(request.slot, heads); }, request.heads);
  if (!request.back.empty()) regions.at[2].usable_area = request.back;
  return regions;
}

/// Returns the slot for layouts, nominal or with its walls moved outwards by `wall` mm.
class Filler {
 public:
  Filler(const FillRequest& request, double wall, Progress progress)
      : request_(request), slot_(request.slot), wall_(wall) {
    slot_.usable_area = slot_.usable_area.inward(-wall, progress);
  }

  Layout lay(Algorithm algorithm, double radius, double overlap, std::span<const std::vector<Point>> hints,
             std::vector<Layout>& regions, Progress progress) const {
    switch (algorithm) {
      case Algorithm::orthocyclic_base:
        return winding::orthocyclic(slot_.usable_area, radius, slot_.tension_point, 0, progress);
      case Algorithm::orthocyclic_flank:
        return winding::orthocyclic(slot_.usable_area, radius, slot_.flank_tension_point, slot_.flank, progress);
      case Algorithm::raabe:
        return winding::raabe(slot_.usable_area, radius, progress, request_.shifts);
      case Algorithm::potential: {
        winding::PotentialOptions options;
        options.overlap = overlap;
        options.seed = request_.seed;
        options.effort = request_.effort;
        options.most = winding::max_wires(slot_.usable_area, radius, 2 * radius - overlap, progress);
        Layout layout{winding::potential(slot_.usable_area, radius, hints, options, progress), {}};
        nearest_first(layout.wires);
        return layout;
      }
      case Algorithm::needle:
        break;
    }
    return needle(radius, regions, progress);
  }

 private:
  const FillRequest& request_;
  winding::Slot slot_;
  double wall_;

  /// A search determines no order of laying: take the order that gives every wire the most support.
  void nearest_first(std::vector<Point>& wires) const {
    std::stable_sort(wires.begin(), wires.end(), [&](Point a, Point b) {
      return square_distance(a, request_.tie_in) < square_distance(b, request_.tie_in);
    });
  }

  Layout needle(double radius, std::vector<Layout>& regions, Progress progress) const {
    winding::LayingRegions at = regions_of(request_);
    for (winding::LayingRegion& region : at.at) region.usable_area = region.usable_area.inward(-wall_, progress);
    winding::NeedleLayout laid = winding::needle(at, radius, request_.tie_in, progress);
    regions.assign(std::make_move_iterator(laid.begin() + 1), std::make_move_iterator(laid.end()));
    return std::move(laid[0]);
  }
};

/// A wire and a slot with random deviations.
struct Sample {
  double diameter, wall;  ///< 0 … 1 and −1 … 1 of the tolerances
};

std::vector<Sample> samples(const FillRequest& request) {
  Random random(request.seed);
  std::vector<Sample> list;
  for (int k = 0; k < request.sampling.samples; ++k) {
    const double diameter = random.uniform();
    list.push_back({diameter, random.uniform(-1, 1)});
  }
  return list;
}

std::vector<std::size_t> sampled_counts(const FillRequest& request, Algorithm algorithm, const Wire& wire,
                                        const std::vector<Sample>& list, Progress progress) {
  std::vector<std::size_t> counts;
  const double tolerance = request.sampling.wire_tolerance.value_or(wire.tolerance);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const double n = static_cast<double>(list.size());
    const Progress part = progress.part(static_cast<double>(k) / n, (static_cast<double>(k) + 1) / n).named("sampling");
    const Filler filler(request, request.sampling.slot_tolerance * list[k].wall, part);
    Wire drawn = wire;
    drawn.outer *= 1 - tolerance * list[k].diameter;
    std::vector<Layout> regions;
    const double overlap = allowed_overlap(request, algorithm, drawn);
    counts.push_back(filler.lay(algorithm, drawn.radius(), overlap, {}, regions, part).wires.size());
  }
  return counts;
}

void report(const FillRequest& request, FilledLayout& filled, Progress progress) {
  const double radius = filled.wire.radius();
  progress.report("bound", 0);
  filled.bound = winding::max_wires(request.slot.usable_area, radius, 2 * radius - filled.overlap, progress);
  progress.report("bound", 0);
  filled.electrical = electrical_fill(request.sides * filled.count(), filled.wire, request.slot.iron.area());
  filled.mechanical = mechanical_fill(filled.count(), filled.wire, request.slot.usable_area.area());
  filled.overlaps = winding::overlaps(filled.layout.wires, radius);
  filled.turns = winding::turns(filled.count(), request.serial, request.parallel);
  filled.resistance =
      resistance_per_metre(filled.wire, std::max<std::size_t>(filled.turns.parallel, 1), request.temperature);
  // In a rotor a wire comes from its own place in the previous winding head; elsewhere its origin is known to the
  // simulation only.
  if (filled.algorithm != Algorithm::needle && std::holds_alternative<winding::RotorHeads>(request.heads))
    filled.layout.tension_points =
        turn_pulls(laying_regions(request.slot, std::get<winding::RotorHeads>(request.heads)), filled.layout);
  winding::LaidCoil coil{request.slot, radius, filled.layout, request.tie_in, request.needle};
  if (!filled.regions.empty()) coil.back = &filled.regions[1];
  if (!request.back.empty()) coil.back_area = &request.back;
  filled.windable = winding::windable(coil, request.producible, progress);
}

std::string max_places(const FillPlan& plan) {
  std::size_t most = 0;
  for (const FilledLayout& filled : plan.layouts) most = std::max(most, filled.count());
  return "the largest has " + std::to_string(most) + " wires";
}

/// Returns the layouts in all regions.
Verification verified(const FillRequest& request, const FillPlan& plan, Progress progress) {
  const winding::LayingRegions at = regions_of(request);
  std::vector<LayoutToVerify> verified;
  for (const FilledLayout& filled : plan.layouts) {
    LayoutToVerify each{name(filled.algorithm), filled.wire.copper,  filled.wire.radius(),
                        filled.overlap,         filled.layout.wires, filled.bound};
    verified.push_back(each);
    for (std::size_t k = 0; k < filled.regions.size(); ++k) {
      each.region = region_name(k);
      each.usable_area = &at.at[k + 1].usable_area;
      each.wires = filled.regions[k].wires;
      each.count = filled.count();
      verified.push_back(each);
    }
  }
  return verify_layouts(request.slot.usable_area, verified, progress);
}

/// Returns the relative computing time of an algorithm.
double weight(Algorithm algorithm) { return algorithm == Algorithm::potential ? 20 : 1; }

}  // namespace

const char* name(Algorithm algorithm) { return name_of<Algorithm>(algorithm, winding::algorithms); }

/// By [Herrmann 4.2.3] two wires may overlap by half of the tolerance of their diameters.
double allowed_overlap(const FillRequest& request, Algorithm algorithm, const Wire& wire) {
  if (algorithm != Algorithm::potential) return 0;
  return request.overlap_tolerance.value_or(0.5 * wire.tolerance) * wire.radius();
}

const char* region_name(std::size_t region) {
  static constexpr const char* names[] = {"head_bottom", "slot_back", "head_top"};
  return names[region];
}

// The search spends a given number of steps on each size of wire, of about a nanosecond each; few wires end sooner,
// because they have few layouts. The constants are fitted to random slots of 10 to 350 wires.
double expected_time(const FillRequest& request) {
  const auto thinnest = std::min_element(request.wires.begin(), request.wires.end(),
                                         [](const Wire& a, const Wire& b) { return a.outer < b.outer; });
  if (thinnest == request.wires.end()) return 0;
  const double most =
      static_cast<double>(winding::max_wires(request.slot.usable_area, thinnest->radius(), 2 * thinnest->radius()));
  const double layouts = 1 + static_cast<double>(request.sampling.samples);
  double sum = 0;
  for (const Wire& wire : request.wires) {
    const double bound = most * std::pow(thinnest->outer / wire.outer, 2);
    for (const Algorithm algorithm : request.algorithms) {
      const double laying = algorithm == Algorithm::potential
                                ? 0.7 * request.effort * std::min(1.0, std::pow(bound / 50, 1.7))
                                : 5e-6 * bound;
      sum += layouts * laying + 1.6e-6 * bound * bound;  // the verdict on what can be wound is quadratic
    }
  }
  return sum;
}

FillPlan plan_fill(const FillRequest& request, Progress progress) {
  FillPlan plan;
  constexpr double verifying = 0.98;  // part of the progress at which verification begins
  // The search goes last of a wire's algorithms: the layouts of the others are its hints.
  std::vector<std::size_t> order(request.algorithms.size());
  double total = 0, done = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[k] = k;
    total += weight(request.algorithms[k]) * static_cast<double>(request.wires.size());
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return weight(request.algorithms[a]) < weight(request.algorithms[b]);
  });
  const std::vector<Sample> drawn = samples(request);
  const Filler filler(request, 0, progress);
  for (const Wire& wire : request.wires) {
    const std::size_t first = plan.layouts.size();
    plan.layouts.resize(first + order.size());
    std::vector<std::vector<Point>> hints;
    for (const std::size_t k : order) {
      FilledLayout& filled = plan.layouts[first + k];
      filled.algorithm = request.algorithms[k];
      filled.wire = wire;
      filled.overlap = allowed_overlap(request, filled.algorithm, wire);
      char cell[64];
      std::snprintf(cell, sizeof cell, "%s, %.3g mm", name(filled.algorithm), wire.copper);
      const double from = verifying * done / total, to = verifying * (done += weight(filled.algorithm)) / total;
      const double nominal = drawn.empty() ? to : from + (to - from) / (1 + static_cast<double>(drawn.size()));
      const double laid = from + 0.9 * (nominal - from);
      const Progress laying = progress.part(from, laid).named(cell);
      const Progress checking = progress.part(laid, nominal).named(cell);
      laying.report({}, 0);
      filled.layout = filler.lay(filled.algorithm, wire.radius(), filled.overlap, hints, filled.regions, laying);
      report(request, filled, checking);
      hints.push_back(filled.layout.wires);
      if (drawn.empty()) continue;
      const Progress rest = progress.part(nominal, to).named(cell);
      filled.sampled = sampled_counts(request, filled.algorithm, wire, drawn, rest);
    }
  }
  if ((request.serial || request.parallel) &&
      std::none_of(plan.layouts.begin(), plan.layouts.end(), [](const FilledLayout& l) { return l.turns.fits; }))
    throw Infeasible("no layout takes the turns asked for: " + max_places(plan));
  plan.verification = verified(request, plan, progress.part(verifying, 1));
  const auto better = [&](std::size_t a, std::size_t b) {
    return plan.layouts[a].electrical > plan.layouts[b].electrical;
  };
  for (std::size_t k = 0; k < order.size(); ++k) {
    std::size_t best = k;
    for (std::size_t i = k; i < plan.layouts.size(); i += order.size())
      if (better(i, best)) best = i;
    plan.best.push_back(best);
    if (k == 0 || better(best, plan.top)) plan.top = best;
  }
  const FilledLayout& top = plan.layouts[plan.top];
  plan.bound =
      with_gap({static_cast<double>(top.bound), 0, "Oler's inequality on the convex hull of the wires' centres",
                BoundQuantity::count, BoundSense::upper, "1"},
               static_cast<double>(top.count()));
  return plan;
}

}  // namespace bahnwerk
