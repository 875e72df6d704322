#include "core/winding/path/link_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace bahnwerk::winding {
namespace {

// Largest numbers of evaluations of J; a start from the turn before gains nothing from more.
constexpr std::size_t evaluations_from_a_neighbour = 250, evaluations_of_a_search = 250, evaluations_of_the_best = 1000;
constexpr double far_rougher = 10;  // factor of J above the smoothest link's that counts as a cusp
constexpr double loop = 1.5;        // rad: by what a loop turns more than a bend, at least
constexpr double unusable = 1e12;   // J of a link that stands still somewhere

}  // namespace

// ∫ κ ds = ∫ |s′ × s″| / |s′|² dv.
double turned_angle(const BezierPiece& piece) {
  double sum = 0;
  constexpr int steps = 128;
  for (int i = 0; i < steps; ++i) {
    const SplineJet jet = piece.at((i + 0.5) / steps);
    const Vec d1 = place(jet[1]), d2 = place(jet[2]);
    sum += norm(cross(d1, d2)) / dot(d1, d1) / steps;
  }
  return sum;
}

double sharpest_curvature(const BezierPiece& piece) {
  constexpr int samples = 256;
  const auto squared_speed = [&](double v) {
    constexpr std::size_t w = spline_dimension;
    const HomogeneousJet jet = piece.homogeneous_at(v);
    double sum = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double slope = (jet[1][d] - jet[1][w] / jet[0][w] * jet[0][d]) / jet[0][w];
      sum += slope * slope;
    }
    return sum;
  };
  double most = 0, before = unusable, here = squared_speed(0);
  for (int i = 0; i < samples; ++i) {
    const double next = squared_speed((i + 1.0) / samples);
    if (here <= before && here <= next) {
      double low = std::max(0.0, (i - 1.0) / samples), high = (i + 1.0) / samples;
      for (int n = 0; n < 40; ++n) {  // ternary search
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (squared_speed(a) < squared_speed(b))
          high = b;
        else
          low = a;
      }
      const SplineJet jet = piece.at((low + high) / 2);
      const Vec d1 = place(jet[1]), d2 = place(jet[2]);
      most = std::max(most, norm(cross(d1, d2)) / std::pow(norm(d1), 3));
    }
    before = here, here = next;
  }
  return most < unusable ? most : unusable;
}

LinkSearch::LinkSearch(const LinkOptions& options)
    : options_(options), rule_(options.continuity), fine_rule_(options.continuity, 256) {}

FoundLink LinkSearch::find(const LinkEnds& ends, const std::optional<FoundLink>& known, Progress progress) const {
  const LinkObjective objective = known ? known->objective : options_.objective;
  const FoundLink found = again(ends, known, objective, progress);
  return found.cusped() && objective == LinkObjective::control_distance
             ? search(ends, LinkObjective::curvature, progress)
             : found;
}

/// Searches from the link of the turn before, and succeeds if the result is about as smooth.
FoundLink LinkSearch::again(const LinkEnds& ends, const std::optional<FoundLink>& known, LinkObjective objective,
                            Progress progress) const {
  if (!known) return search(ends, objective, progress);
  const FoundLink found = solve(ends, known->best.shape, objective, evaluations_from_a_neighbour, progress);
  return found.best.smoothness <= 1.5 * known->best.smoothness ? found : search(ends, objective, progress);
}

/// Searches with a quadrature rule.
LinkSearch::ByRule LinkSearch::by(const SmoothnessRule& rule, const LinkEnds& ends, const BestLinkOptions& options,
                                  Progress progress) const {
  FoundLink found{best_link(rule, ends, options, progress), options.objective, 0};
  const double seen = found.best.smoothness;
  found.bend = sharpest_curvature(link(options_.continuity, ends, found.best.shape));
  const double j = smoothness(fine_rule_, ends, found.best.shape, options_.weights);
  found.best.smoothness = j < unusable ? std::max(j, options_.weights.rate * found.bend) : unusable;
  return {found, seen};
}

/// A bend so sharp that it lies between the nodes of the quadrature looks smooth; if a finer rule gives a larger J, the
/// search is repeated with that rule.
FoundLink LinkSearch::solve(const LinkEnds& ends, const LinkShape& start, LinkObjective objective,
                            std::size_t evaluations, Progress progress) const {
  const BestLinkOptions options{objective, options_.weights, start, evaluations};
  const ByRule found = by(rule_, ends, options, progress);
  return found.link.best.smoothness <= 1.05 * found.smoothness ? found.link
                                                               : by(fine_rule_, ends, options, progress).link;
}

/// Searches from several starts: links that leave their neighbours' tangents early or late. (4.60) prefers a wide loop,
/// a far longer path, to a direct link; of the links that turn by about the least angle, the smoothest is taken.
FoundLink LinkSearch::search(const LinkEnds& ends, LinkObjective objective, Progress progress) const {
  std::vector<std::pair<double, BestLink>> found;
  double smoothest = unusable;
  const double chord = norm(place(ends.after[0]) - place(ends.before[0]));
  for (const double speed : {1.0, 0.5, 2.0, 4.0}) {
    LinkShape start;
    start.before[0] = norm(place(ends.before[1])) / (speed * chord);
    start.after[0] = norm(place(ends.after[1])) / (speed * chord);
    const BestLink best = solve(ends, start, objective, evaluations_of_a_search, progress).best;
    found.emplace_back(turned_angle(link(options_.continuity, ends, best.shape)), best);
    smoothest = std::min(smoothest, best.smoothness);
  }
  double least = unusable;  // least angle of those that are no cusps
  const auto usable = [&](const BestLink& each) { return each.smoothness <= far_rougher * smoothest; };
  for (const auto& [angle, each] : found)
    if (usable(each)) least = std::min(least, angle);
  const BestLink* best = nullptr;
  for (const auto& [angle, each] : found)
    if (angle <= least + loop && usable(each) && (best == nullptr || each.smoothness < best->smoothness)) best = &each;
  return solve(ends, best->shape, objective, evaluations_of_the_best, progress);
}

}  // namespace bahnwerk::winding
