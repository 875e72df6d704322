#include "core/winding/packing/overlap_energy.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double hopeless = 300;  // times the squared force: energy that a descent may still lose
constexpr double skin = 0.35;     // part of the distance: pairs are listed that much further than they act

/// Four independent sums avoid waiting for each addition.
double product(std::span<const Point> a, std::span<const Point> b) {
  double x = 0, y = 0, u = 0, v = 0;
  const std::size_t n = a.size();
  std::size_t i = 0;
  for (; i + 1 < n; i += 2) {
    x += a[i].x * b[i].x;
    y += a[i].y * b[i].y;
    u += a[i + 1].x * b[i + 1].x;
    v += a[i + 1].y * b[i + 1].y;
  }
  if (i < n) x += dot(a[i], b[i]);
  return (x + u) + (y + v);
}

}  // namespace

void OverlapEnergy::list(std::span<const Point> wires) {
  listed_.assign(wires.begin(), wires.end());
  pairs_.clear();
  const double reach = (1 + skin) * distance_, square = reach * reach;
  const std::size_t n = wires.size();
  if (n <= 48) {
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t k = i + 1; k < n; ++k)
        if (square_distance(wires[i], wires[k]) < square) pairs_.push_back({i, k});
    work_ += n * n;
    return;
  }
  Point low = wires[0], high = wires[0];
  for (const Point& p : wires) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  // Wires may be distributed far more sparsely than they are wide.
  const double side = std::max(reach, std::sqrt((high.x - low.x) * (high.y - low.y) / (4.0 * static_cast<double>(n))));
  const auto columns = static_cast<std::size_t>((high.x - low.x) / side) + 1;
  const auto rows = static_cast<std::size_t>((high.y - low.y) / side) + 1;
  start_.assign(columns * rows + 1, 0);
  cell_of_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto column = std::min(columns - 1, static_cast<std::size_t>((wires[i].x - low.x) / side));
    const auto row = std::min(rows - 1, static_cast<std::size_t>((wires[i].y - low.y) / side));
    cell_of_[i] = static_cast<std::uint32_t>(row * columns + column);
    ++start_[cell_of_[i]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& s : start_) sum = s += sum;
  member_.resize(n);
  for (std::size_t i = n; i-- > 0;) member_[--start_[cell_of_[i]]] = static_cast<std::uint32_t>(i);
  const auto among = [&](std::uint32_t i, std::size_t cell, std::uint32_t from) {
    for (std::uint32_t m = std::max(start_[cell], from); m < start_[cell + 1]; ++m)
      if (square_distance(wires[i], wires[member_[m]]) < square) pairs_.push_back({i, member_[m]});
  };
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t cell = row * columns + column;
      for (std::uint32_t m = start_[cell]; m < start_[cell + 1]; ++m) {
        const std::uint32_t i = member_[m];
        among(i, cell, m + 1);
        if (column + 1 < columns) among(i, cell + 1, 0);
        if (row + 1 == rows) continue;
        if (column > 0) among(i, cell + columns - 1, 0);
        among(i, cell + columns, 0);
        if (column + 1 < columns) among(i, cell + columns + 1, 0);
      }
    }
  work_ += 60 * n;
}

double OverlapEnergy::energy(std::span<const Point> wires, std::span<Point> gradient, double& deepest) {
  const std::size_t n = wires.size();
  bool stale = listed_.size() != n;
  const double moved = 0.25 * skin * skin * distance_ * distance_;
  for (std::size_t i = 0; i < n && !stale; ++i) stale = square_distance(wires[i], listed_[i]) > moved;
  if (stale) list(wires);
  work_ += 2 * pairs_.size() + 27 * n + 150;
  double sum = 0, deep = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point in = usable_area_.way_in(wires[i]);
    gradient[i] = -in;
    const double square = dot(in, in);
    sum += square;
    deep = std::max(deep, square);
  }
  deep = std::sqrt(deep);
  const double least = distance_ * distance_;
  for (const Pair& pair : pairs_) {
    const Point d = wires[pair.a] - wires[pair.b];
    const double square = dot(d, d);
    if (square >= least) continue;
    const double apart = std::sqrt(square), overlap = distance_ - apart;
    sum += overlap * overlap;
    deep = std::max(deep, overlap);
    // Wires on one point are separated along x.
    const Point force = apart > 0 ? (overlap / apart) * d : Point{overlap, 0};
    gradient[pair.a] -= force;
    gradient[pair.b] += force;
  }
  deepest = deep;
  return 0.5 * sum;
}

void OverlapEnergy::share(std::span<const Point> wires, std::vector<double>& of_each) {
  list(wires);
  of_each.assign(wires.size(), 0);
  for (std::size_t i = 0; i < wires.size(); ++i) {
    const Point in = usable_area_.way_in(wires[i]);
    of_each[i] += dot(in, in);
  }
  for (const Pair& pair : pairs_) {
    const double overlap = distance_ - bahnwerk::distance(wires[pair.a], wires[pair.b]);
    if (overlap <= 0) continue;
    of_each[pair.a] += 0.5 * overlap * overlap;
    of_each[pair.b] += 0.5 * overlap * overlap;
  }
}

Rest Minimiser::minimise(OverlapEnergy& overlap, std::vector<Point>& wires, double goal, int most, Progress progress) {
  const std::size_t n = wires.size();
  for (auto* list : {&gradient_, &trial_, &trial_gradient_, &direction_}) list->resize(n);
  for (std::size_t k = 0; k < memory; ++k) {
    step_[k].resize(n);
    change_[k].resize(n);
  }
  const double longest = 0.15 * overlap.distance();
  double deepest = 0;
  double energy = overlap.energy(wires, gradient_, deepest);
  std::size_t kept = 0, next = 0;
  double earlier = energy;
  const int steps_per_report = static_cast<int>(2000000 / (10 * n + 1)) + 1;  // steps between two reports
  for (int step = 0; step < most && deepest > resolution; ++step) {
    if (step % steps_per_report == steps_per_report - 1) progress.report("potential", 0);
    const double square = product(gradient_, gradient_);
    // Forces balance although wires overlap: a local minimum.
    if (square <= 1e-5 * energy) break;
    // Not even soft directions lead below the goal any more.
    if (hopeless * square < energy - goal) break;
    if (step % 40 == 39) {
      if (energy > 0.98 * earlier) break;
      earlier = energy;
    }
    // Two-loop recursion of L-BFGS [Nocedal, Updating quasi-Newton matrices with limited storage, 1980].
    for (std::size_t i = 0; i < n; ++i) direction_[i] = -gradient_[i];
    double alpha[memory];
    for (std::size_t k = 0; k < kept; ++k) {
      const std::size_t at = (next + memory - 1 - k) % memory;
      alpha[at] = weight_[at] * product(step_[at], direction_);
      for (std::size_t i = 0; i < n; ++i) direction_[i] -= alpha[at] * change_[at][i];
    }
    if (kept > 0) {
      const std::size_t last = (next + memory - 1) % memory;
      const double scale = 1 / (weight_[last] * product(change_[last], change_[last]));
      for (Point& d : direction_) d = scale * d;
    } else {
      for (Point& d : direction_) d = 0.5 * d;
    }
    for (std::size_t k = kept; k-- > 0;) {
      const std::size_t at = (next + memory - 1 - k) % memory;
      const double beta = weight_[at] * product(change_[at], direction_);
      for (std::size_t i = 0; i < n; ++i) direction_[i] += (alpha[at] - beta) * step_[at][i];
    }
    double slope = product(gradient_, direction_);
    if (!(slope < 0)) {
      for (std::size_t i = 0; i < n; ++i) direction_[i] = -gradient_[i];
      slope = -square;
      kept = 0;
    }
    double far = 0;
    for (const Point& d : direction_) far = std::max(far, dot(d, d));
    double length = std::min(1.0, longest / std::sqrt(far));
    double trial_energy = 0, trial_deepest = 0;
    bool lower = false;
    for (int halving = 0; halving < 12; ++halving) {
      for (std::size_t i = 0; i < n; ++i) trial_[i] = wires[i] + length * direction_[i];
      trial_energy = overlap.energy(trial_, trial_gradient_, trial_deepest);
      lower = trial_energy <= energy + 1e-4 * length * slope;
      if (lower) break;
      length *= 0.5;
    }
    if (!lower) {
      if (kept == 0) break;
      kept = 0;  // tries once more along the plain gradient
      continue;
    }
    std::vector<Point>&moved = step_[next], &turned = change_[next];
    for (std::size_t i = 0; i < n; ++i) {
      moved[i] = trial_[i] - wires[i];
      turned[i] = trial_gradient_[i] - gradient_[i];
    }
    const double curvature = product(moved, turned);
    if (curvature > 1e-10 * product(moved, moved)) {
      weight_[next] = 1 / curvature;
      next = (next + 1) % memory;
      kept = std::min(kept + 1, memory);
    }
    wires.swap(trial_);
    gradient_.swap(trial_gradient_);
    energy = trial_energy;
    deepest = trial_deepest;
  }
  return {energy, deepest <= resolution};
}

}  // namespace bahnwerk::winding
