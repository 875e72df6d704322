#include "core/contour/blend/layout.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::blending {

namespace {

constexpr double crowded_turn = 0.8, crowded_curvature = 0.35;
constexpr double movable_below =
    0.99;  // part of the length allowed by the tolerance below which a blend may move into a run

/// A run around a crowded joint swallows the movable blends and runs before it that it overlaps.
void add_run(std::vector<Change>& list, double a, double b) {
  while (!list.empty() && list.back().b > a) {
    const Change& last = list.back();
    if (!last.run && !last.movable) {
      a = last.b;
      break;
    }
    a = std::min(a, last.a);
    b = std::max(b, last.b);
    list.pop_back();
  }
  if (b > a) list.push_back({a, b, true, 0, false});
}

}  // namespace

std::vector<Change> lay_out(const ElementRun& stretch, double tolerance, const std::vector<Ability>& ability,
                            ProgressScope& progress) {
  const auto& elements = stretch.elements;
  const std::size_t n = elements.size();
  std::vector<Change> list;
  if (n < 2) return list;
  std::vector<Reach> reaches(n + 1);
  std::vector<bool> turns(n + 1, false);
  for (std::size_t j = 1; j < n; ++j) {
    progress.work();
    const JointShape shape = joint_shape(elements[j - 1], elements[j]);
    reaches[j] = reach(shape, tolerance, ability[j - 1].speed > ability[j].speed ? ability[j - 1] : ability[j]);
    turns[j] = shape.turn > 0;
  }
  // Returns the part of a segment that a joint may take when another one requests it, too.
  const auto share = [&](std::size_t element, double mine, double other) {
    const double length = elements[element].length;
    return std::min(mine, std::max(0.5 * length, length - other));
  };
  for (std::size_t j = 1; j < n; ++j) {
    const double want = reaches[j].wanted, t = elements[j].begin;
    if (!(want > 0)) continue;
    const double d = std::min(share(j - 1, want, reaches[j - 1].wanted), share(j, want, reaches[j + 1].wanted));
    if (d < reaches[j].least) continue;
    if (d < (turns[j] ? crowded_turn : crowded_curvature) * want) {
      add_run(list, std::max(0.0, t - want), std::min(stretch.length(), t + want));
      continue;
    }
    const bool movable = want < movable_below * reaches[j].allowed;
    if (!list.empty() && list.back().b > t - d) {
      if (movable && list.back().run) {
        list.back().b = std::max(list.back().b, t + d);
        continue;
      }
      if (list.back().run) list.back().b = t - d;  // only runs reach further than their share
    }
    const double a = list.empty() ? t - d : std::max(t - d, list.back().b);
    list.push_back({a, t + d, false, j, movable});
  }
  std::erase_if(list, [](const Change& c) { return !(c.b > c.a); });
  return list;
}

std::vector<std::size_t> sharpest_joints(const ElementRun& stretch, double a, double b,
                                         const std::vector<double>& failure_positions, std::size_t hint) {
  std::vector<std::size_t> cuts;
  for (const double t : failure_positions) {
    const std::size_t here = stretch.find(t, hint);
    std::size_t best = 0;
    double sharpest = 0;
    for (std::size_t j = here > 2 ? here - 2 : 1; j < std::min(stretch.elements.size(), here + 4); ++j) {
      const double border = stretch.elements[j].begin;
      if (!(border > a && border < b)) continue;
      const double turn = joint_shape(stretch.elements[j - 1], stretch.elements[j]).turn;
      if (turn > sharpest) sharpest = turn, best = j;
    }
    if (best > 0 && (cuts.empty() || best > cuts.back())) cuts.push_back(best);
  }
  return cuts;
}

}  // namespace bahnwerk::blending
