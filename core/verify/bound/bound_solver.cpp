#include "core/verify/bound/bound_solver.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/bound/axis_travel.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double negligible_time = 1e-10;  // share of the whole

}  // namespace

template <int N>
void BoundSolver<N>::grow() {
  const std::size_t n = grid_.ids();
  ahead_.resize(n, unsolved), b_.resize(n, unsolved), time_.resize(n), active_.resize(n), state_.resize(n);
}

template <int N>
void BoundSolver<N>::solve() {
  ahead_.clear(), b_.clear(), time_.clear(), active_.clear(), state_.clear();
  looked_ = false;
  solve({{0, static_cast<std::uint32_t>(grid_.order().size() - 1)}});
}

template <int N>
void BoundSolver<N>::solve_changes() {
  solve(grid_.fresh());
}

template <int N>
void BoundSolver<N>::solve(const std::vector<Span>& fresh) {
  grow();
  forwards(fresh);
  backwards();
}

template <int N>
void BoundSolver<N>::forwards(const std::vector<Span>& all) {
  const std::vector<std::uint32_t>& order = grid_.order();
  const auto n = static_cast<std::uint32_t>(order.size());
  reached_.clear();
  std::uint32_t i = 0;  // index behind the last node reached
  for (const Span& fresh : all) {
    if (fresh.last < i) continue;
    const std::uint32_t first = std::max(fresh.first, i);
    bool changed = true;
    for (i = first; i < n && (i <= fresh.last || changed); ++i) {
      const std::uint32_t id = order[i];
      const Node& node = grid_.node_of(id);
      double b = node.cap;
      if (i > 0) {
        const std::uint32_t before = order[i - 1];
        b = std::min(b, across(grid_.cell_of(before), grid_.node_of(before), node, ahead_[before]));
      }
      changed = b != ahead_[id];
      ahead_[id] = b;
      if (i % 64 == 0) progress_.work(8);
    }
    if (!reached_.empty() && reached_.back().last == first)
      reached_.back().last = i;
    else
      reached_.push_back({first, i});
  }
}

template <int N>
void BoundSolver<N>::backwards() {
  const std::vector<std::uint32_t>& order = grid_.order();
  std::uint32_t i = static_cast<std::uint32_t>(order.size());  // the first node reached
  std::size_t kept = reached_.size();
  for (std::size_t r = reached_.size(); r-- > 0;) {
    const Span span = reached_[r];
    if (span.first >= i) continue;
    const std::uint32_t last = std::min(span.last, i);
    bool changed = true;
    for (i = last; i > 0 && (i > span.first || changed);) {
      const std::uint32_t id = order[--i];
      double b = ahead_[id];
      if (i + 1 < order.size()) {
        const std::uint32_t after = order[i + 1];
        b = std::min(b, across(grid_.cell_of(id), grid_.node_of(after), grid_.node_of(id), b_[after]));
      }
      changed = b != b_[id];
      b_[id] = b;
      if (i + 1 < order.size()) look_at(grid_.node_of(id), grid_.node_of(order[i + 1]));
      if (i % 64 == 0) progress_.work(64);
    }
    if (kept < reached_.size() && reached_[kept].first == last)
      reached_[kept].first = i;
    else
      reached_[--kept] = {i, last};
  }
  reached_.erase(reached_.begin(), reached_.begin() + static_cast<std::ptrdiff_t>(kept));
}

template <int N>
void BoundSolver<N>::look_at(const Node& from, const Node& to) {
  const Cell& cell = grid_.cell_of(from.id);
  unsigned char& active = active_[from.id];
  time_[from.id] = time_of(cell, from, to, active);
  state_[from.id] =
      static_cast<unsigned char>((cell.kind == Cell::Kind::curved ? curved : 0) | (cell.divisible ? divisible : 0) |
                                 (cell.divisible && (active == 0 || disputed(active, from, to)) ? mixed : 0));
}

template <int N>
double BoundSolver<N>::duration(std::size_t cells) const {
  const std::vector<std::uint32_t>& order = grid_.order();
  double sum = 0, lost = 0;  // Kahan, Commun. ACM 8 (1965), over sums of few: what a cell gives must not get lost
  for (std::size_t i = 0; i < cells;) {
    double part = 0;
    for (const std::size_t end = std::min(i + 32, cells); i < end; ++i) part += time_[order[i]];
    const double term = part - lost, next = sum + term;
    lost = (next - sum) - term;
    sum = next;
    progress_.work(1);
  }
  return sum;
}

template <int N>
std::size_t BoundSolver<N>::mark_valleys(std::vector<unsigned char>& marked) const {
  const std::vector<std::uint32_t>& order = grid_.order();
  const std::size_t cells = order.size() - 1;
  marked.assign(cells, 0);
  std::size_t count = 0;
  for (const Span& fresh : grid_.fresh())
    for (std::size_t i = fresh.first; i < fresh.last; ++i) {
      const Cell& cell = grid_.cell_of(order[i]);
      if (!cell.divisible || !(b_[order[i]] + b_[order[i + 1]] > 2 * cell.valley)) continue;
      marked[i] = 1;
      ++count;
    }
  return count;
}

template <int N>
typename BoundSolver<N>::Doubt BoundSolver<N>::mark_switching(double total, std::vector<unsigned char>& marked) {
  const std::vector<std::uint32_t>& order = grid_.order();
  const std::size_t cells = order.size() - 1;
  marked.assign(cells, 0);
  if (!looked_) reached_.assign(1, {0, static_cast<std::uint32_t>(order.size())});
  looked_ = true;
  const auto changes = [&](std::uint32_t id, std::uint32_t other) {
    return (state_[other] & curved) != 0 && active_[id] != active_[other];
  };
  Doubt doubt;
  std::size_t i = 0;
  for (const Span& span : reached_)  // marks the neighbours of new cells, too
    for (i = std::max<std::size_t>(i, span.first > 1 ? span.first - 1 : 0); i < cells && i <= span.last; ++i) {
      if (i % 64 == 0) progress_.work(8);
      const std::uint32_t id = order[i];
      if ((state_[id] & divisible) == 0 || time_[id] < negligible_time * total) continue;
      if ((state_[id] & mixed) != 0) doubt.time += time_[id];
      marked[i] = (state_[id] & mixed) != 0 || (i > 0 && changes(id, order[i - 1])) ||
                  (i + 1 < cells && changes(id, order[i + 1]));
      doubt.cells += marked[i];
    }
  return doubt;
}

// The condition that binds between both ends asks of another axis more than it can give at one of them, or in between:
// as far above the larger of both as they differ by.
template <int N>
bool BoundSolver<N>::disputed(unsigned active, const Node& from, const Node& to) const {
  const std::size_t kind = active < 2 ? 2 : (active - 2u) % 3, axis = active < 2 ? 0 : (active - 2u) / 3;
  const auto along = [&](const Node& n, double& a) {  // acceleration along the path; false: unknown here
    a = 0;
    if (active < 2) return true;
    const double t = n.tangent[axis];
    if (std::abs(t) < 1e-6) return false;
    const double limit = grid_.acceleration(axis), own = kind == 2 ? 0 : (kind == 0) == (t > 0) ? limit : -limit;
    a = (own - n.curvature[axis] * b_[n.id]) / t;
    return true;
  };
  double a0 = 0, a1 = 0;
  const bool first = along(from, a0), last = along(to, a1);
  const double b0 = b_[from.id], b1 = b_[to.id];
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    const double limit = grid_.acceleration(k), asked0 = from.curvature[k] * b0 + from.tangent[k] * a0,
                 asked1 = to.curvature[k] * b1 + to.tangent[k] * a1;
    const double most0 = first ? std::abs(asked0) : 0, most1 = last ? std::abs(asked1) : 0,
                 most = std::max(most0, most1);
    if (most > limit * 1.0001) return true;
    if (first && last && k != axis && most + std::abs(asked1 - asked0) > limit) return true;
  }
  return false;
}

template <int N>
double BoundSolver<N>::time_of(const Cell& cell, const Node& from, const Node& to, unsigned char& active) const {
  active = 0;
  if (cell.kind == Cell::Kind::joint) return 0;
  const double feed = grid_.feed(from.segment), b0 = b_[from.id], b1 = b_[to.id];
  if (cell.kind == Cell::Kind::straight) {  // all axes share one law: limits add up to limits of the path
    double acceleration = std::numeric_limits<double>::infinity(), velocity = feed;
    for (std::size_t k = 0; k < grid_.axes(); ++k) {
      const double t = std::abs(from.tangent[k]);
      if (!(t > 1e-12)) continue;
      acceleration = std::min(acceleration, grid_.acceleration(k) / t);
      velocity = std::min(velocity, grid_.velocity(k) / t);
    }
    return travel_time(b0, b1, cell.length, acceleration, velocity);
  }
  const double full = 1 - 1e-7;
  if (b0 >= sq(feed) * full && b1 >= sq(feed) * full) active = 1;
  const Lanes<N> e0 = most(from) * b0, e1 = most(to) * b1;
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    if (std::max(sq(from.tangent[k]), sq(to.tangent[k])) < negligible_direction) continue;
    const double change = e1[k] - e0[k], v2 = sq(grid_.velocity(k)) * full;
    if (change >= cell.energy[k] * full) active = static_cast<unsigned char>(2 + 3 * k);
    if (-change >= cell.energy[k] * full) active = static_cast<unsigned char>(3 + 3 * k);
    if (e0[k] >= v2 && e1[k] >= v2) active = static_cast<unsigned char>(4 + 3 * k);
  }
  return std::max(cell.length / feed,
                  slowest<N>(e0, e1, lanes(cell.displacement), lanes(grid_.accelerations()), lanes(cell.velocity)));
}

template class BoundSolver<2>;
template class BoundSolver<3>;
template class BoundSolver<5>;
template class BoundSolver<8>;

}  // namespace bahnwerk::verify
