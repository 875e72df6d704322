#include "core/verify/redundant/reachable_states.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk {
namespace {

constexpr double wider = 1e-9;
constexpr std::size_t most_vertices = 96, vertices_before_simplifying = 128;

}  // namespace

ReachableStates ReachableStates::box(double lowest, double highest, double velocity) {
  ReachableStates s;
  const double a = lowest - wider, b = highest + wider, v = velocity + wider;
  if (a < b) s.vertices_ = {{a, -v}, {b, -v}, {b, v}, {a, v}};
  return s;
}

bool ReachableStates::holds(double x, double v) const {
  const std::size_t n = vertices_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const State &a = vertices_[i], &b = vertices_[i + 1 < n ? i + 1 : 0];
    if ((b.x - a.x) * (v - a.v) - (b.v - a.v) * (x - a.x) < -wider * std::hypot(b.x - a.x, b.v - a.v)) return false;
  }
  return !empty();
}

void ReachableStates::coast(double h) {
  for (State& s : vertices_) s.x += h * s.v;
}

void ReachableStates::advance(double h, double velocity, double acceleration) {
  if (empty()) return;
  const auto by_place = [](const State& a, const State& b) { return a.x < b.x; };
  const auto [low, high] = std::minmax_element(vertices_.begin(), vertices_.end(), by_place);
  const double lowest = low->x - h * velocity, highest = high->x + h * velocity;
  coast(h);
  // The hexagon is the Minkowski sum of three segments.
  const double v = 0.25 * h * acceleration, x = h * v;
  add_segment({0, v});
  add_segment({x, 2 * v});
  add_segment({x, v});
  limit(lowest, highest, velocity);
  if (vertices_.size() > vertices_before_simplifying) simplify();
}

/// Adds (Minkowski sum) the segment from −g to g: every vertex moves by +g or −g, whichever lies farther outside, and a
/// vertex at which the sign changes becomes two.
void ReachableStates::add_segment(State g) {
  spare_.clear();
  const std::size_t n = vertices_.size();
  if (n == 0) return;
  const auto side = [&](std::size_t i) {  // whether the outward normal of the edge from vertex i on points along g
    const State &a = vertices_[i], &b = vertices_[i + 1 < n ? i + 1 : 0];
    const double along = g.x * (b.v - a.v) - g.v * (b.x - a.x);
    return along > 0 ? 1 : along < 0 ? -1 : 0;
  };
  int before = side(n - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const int after = side(i);
    const State& p = vertices_[i];
    if (before != 0) spare_.push_back({p.x + before * g.x, p.v + before * g.v});
    if (after != 0 && after != before) spare_.push_back({p.x + after * g.x, p.v + after * g.v});
    before = after;
  }
  std::swap(vertices_, spare_);
}

void ReachableStates::cut(double x, double v, double most) {
  const std::size_t n = vertices_.size();
  const auto beyond = [&](const State& s) { return x * s.x + v * s.v - most; };
  if (std::all_of(vertices_.begin(), vertices_.end(), [&](const State& s) { return beyond(s) <= 0; })) return;
  spare_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const State &a = vertices_[i], &b = vertices_[i + 1 < n ? i + 1 : 0];
    const double from = beyond(a), to = beyond(b);
    if (from <= 0) spare_.push_back(a);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
      const double share = from / (from - to);
      spare_.push_back({a.x + share * (b.x - a.x), a.v + share * (b.v - a.v)});
    }
  }
  std::swap(vertices_, spare_);
}

void ReachableStates::limit(double lowest, double highest, double velocity) {
  cut(1, 0, highest + wider);
  cut(-1, 0, -lowest + wider);
  cut(0, 1, velocity + wider);
  cut(0, -1, velocity + wider);
}

void ReachableStates::scale_velocity(double factor) {
  double fastest = 0;
  for (const State& s : vertices_) fastest = std::max(fastest, std::abs(s.v));
  add_segment({0, (factor - 1) * fastest});
}

ReachableStates ReachableStates::reversed() const {
  ReachableStates s = *this;
  for (State& state : s.vertices_) state.v = -state.v;
  std::reverse(s.vertices_.begin(), s.vertices_.end());
  return s;
}

ReachableStates ReachableStates::subtracted_from(double x) const {
  ReachableStates s = *this;
  for (State& state : s.vertices_) state = {x - state.x, -state.v};  // half a turn
  return s;
}

ReachableStates ReachableStates::plus(const ReachableStates& other) const {
  ReachableStates sum;
  if (empty() || other.empty()) return sum;
  const auto lowest = [](const std::vector<State>& list) {
    return static_cast<std::size_t>(
        std::min_element(list.begin(), list.end(),
                         [](const State& a, const State& b) { return a.v < b.v || (a.v == b.v && a.x < b.x); }) -
        list.begin());
  };
  // Merge the edges of both polygons by direction.
  const std::size_t n = vertices_.size(), m = other.vertices_.size(), first = lowest(vertices_),
                    second = lowest(other.vertices_);
  const auto edge = [](const std::vector<State>& list, std::size_t i) {
    const State &a = list[i % list.size()], &b = list[(i + 1) % list.size()];
    return State{b.x - a.x, b.v - a.v};
  };
  std::size_t i = 0, j = 0;
  State at{vertices_[first].x + other.vertices_[second].x, vertices_[first].v + other.vertices_[second].v};
  while (i < n || j < m) {
    sum.vertices_.push_back(at);
    const State a = edge(vertices_, first + i), b = edge(other.vertices_, second + j);
    const bool own = j == m || (i < n && a.x * b.v - a.v * b.x >= 0);
    const State& step = own ? a : b;
    at = {at.x + step.x, at.v + step.v};
    ++(own ? i : j);
  }
  return sum;
}

void ReachableStates::limit(const ReachableStates& other) {
  const std::size_t n = other.vertices_.size();
  if (other.empty()) vertices_.clear();
  for (std::size_t i = 0; i < n && !empty(); ++i) {
    const State &a = other.vertices_[i], &b = other.vertices_[i + 1 < n ? i + 1 : 0];
    const double x = b.v - a.v, v = a.x - b.x, size = std::hypot(x, v);
    if (!(size > wider)) continue;  // what it leaves out is not larger than what limits are widened by
    cut(x / size, v / size, (x * a.x + v * a.v) / size + wider);
  }
}

/// Removes the edges whose removal enlarges the set least, no two adjacent ones: the neighbours of a removed edge are
/// extended until they meet.
void ReachableStates::simplify() {
  const std::size_t n = vertices_.size();
  struct Removal {
    double added = 0;
    std::size_t edge = 0;
    State corner;
  };
  std::vector<Removal> list;
  list.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const State &p = vertices_[(i + n - 1) % n], &a = vertices_[i], &b = vertices_[(i + 1) % n],
                &q = vertices_[(i + 2) % n];
    const State before{a.x - p.x, a.v - p.v}, after{b.x - q.x, b.v - q.v}, edge{b.x - a.x, b.v - a.v};
    // a + s·before = b + t·after
    const double turn = before.v * after.x - before.x * after.v;
    if (!(turn > 0)) continue;
    const double s = (edge.v * after.x - edge.x * after.v) / turn;
    if (!(s >= 0) || !std::isfinite(s)) continue;
    const State meet{a.x + s * before.x, a.v + s * before.v};
    list.push_back({std::abs(edge.x * (meet.v - a.v) - edge.v * (meet.x - a.x)), i, meet});
  }
  std::sort(list.begin(), list.end(), [](const Removal& a, const Removal& b) { return a.added < b.added; });
  std::vector<char> touched(n), gone(n);
  std::size_t left = n;
  for (const Removal& r : list) {
    if (left <= most_vertices) break;
    // The two vertices of the edge become one, and the edges on both sides get longer.
    bool free = true;
    for (const std::size_t k : {r.edge + n - 1, r.edge, r.edge + 1, r.edge + 2}) free = free && touched[k % n] == 0;
    if (!free) continue;
    for (const std::size_t k : {r.edge + n - 1, r.edge, r.edge + 1, r.edge + 2}) touched[k % n] = 1;
    vertices_[r.edge] = r.corner;
    gone[(r.edge + 1) % n] = 1;
    --left;
  }
  spare_.clear();
  for (std::size_t i = 0; i < n; ++i)
    if (gone[i] == 0) spare_.push_back(vertices_[i]);
  std::swap(vertices_, spare_);
}

}  // namespace bahnwerk
