#include "core/contour/blend/layout.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::blending {

namespace {

constexpr double crowded_turn = 0.8, crowded_bend = 0.35;
constexpr double movable_below = 0.99;  // of what the tolerance allows

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

std::vector<Change> lay_out(const Stretch& stretch, double tolerance, const std::vector<Ability>& ability) {
  const auto& elements = stretch.elements;
  const std::size_t n = elements.size();
  std::vector<Change> list;
  if (n < 2) return list;
  std::vector<Reach> reaches(n + 1);
  std::vector<bool> turns(n + 1, false);
  for (std::size_t j = 1; j < n; ++j) {
    const JointShape shape = joint_shape(elements[j - 1], elements[j]);
    reaches[j] = reach(shape, tolerance, ability[j - 1].speed > ability[j].speed ? ability[j - 1] : ability[j]);
    turns[j] = shape.turn > 0;
  }
  // What a joint may take of a segment that another one wants too.
  const auto share = [&](std::size_t element, double mine, double other) {
    const double length = elements[element].length;
    return std::min(mine, std::max(0.5 * length, length - other));
  };
  for (std::size_t j = 1; j < n; ++j) {
    const double want = reaches[j].wanted, t = elements[j].begin;
    if (!(want > 0)) continue;
    const double d = std::min(share(j - 1, want, reaches[j - 1].wanted), share(j, want, reaches[j + 1].wanted));
    if (d < (turns[j] ? crowded_turn : crowded_bend) * want) {
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

}  // namespace bahnwerk::blending
