#include "core/redundant/chain/controllable_set.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

constexpr std::size_t most_vertices = 96;

double cross(const ChainState<2>& a, const ChainState<2>& b) { return a[0] * b[1] - a[1] * b[0]; }
ChainState<2> minus(const ChainState<2>& a, const ChainState<2>& b) { return {a[0] - b[0], a[1] - b[1]}; }

}  // namespace

ControllableSet ControllableSet::at_node(const std::array<Range, 2>& boxes, bool rest) {
  ControllableSet s;
  const Range &x = boxes[0], &v = boxes[1];
  if (x.lowest > x.highest || (!rest && v.lowest > v.highest)) return s;
  if (rest)
    s.vertices_ = {{x.lowest, 0}, {x.highest, 0}};
  else
    s.vertices_ = {{x.lowest, v.lowest}, {x.highest, v.lowest}, {x.highest, v.highest}, {x.lowest, v.highest}};
  return s;
}

void ControllableSet::advance(double h, const Range& controls) {
  const double middle = controls.middle(), half = 0.5 * controls.width();
  for (State& s : vertices_) s = advanced<2>(s, h, middle);
  if (half > 0) add_segment({0.5 * h * h * half, h * half});
  if (vertices_.size() > most_vertices) reduce();
}

void ControllableSet::add_segment(const State& g) {
  const std::size_t n = vertices_.size();
  if (n == 0) return;
  spare_.clear();
  const auto side = [&](std::size_t i) {
    const double c = cross(g, minus(vertices_[i + 1 < n ? i + 1 : 0], vertices_[i]));
    return c > 0 ? 1 : c < 0 ? -1 : 0;
  };
  int before = side(n - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const int after = side(i);
    const State& p = vertices_[i];
    if (before != 0) spare_.push_back({p[0] + before * g[0], p[1] + before * g[1]});
    if (after != 0 && after != before) spare_.push_back({p[0] + after * g[0], p[1] + after * g[1]});
    before = after;
  }
  if (spare_.empty()) {  // one place, or a line along g
    const auto [low, high] = std::minmax_element(
        vertices_.begin(), vertices_.end(),
        [&](const State& a, const State& b) { return a[0] * g[0] + a[1] * g[1] < b[0] * g[0] + b[1] * g[1]; });
    spare_ = {minus(*low, g), {(*high)[0] + g[0], (*high)[1] + g[1]}};
  }
  std::swap(vertices_, spare_);
}

/// Removes the vertices whose triangles with their neighbours have the least areas.
void ControllableSet::reduce() {
  while (vertices_.size() > most_vertices) {
    const std::size_t n = vertices_.size();
    std::size_t best = 0;
    double least = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const State &p = vertices_[(i + n - 1) % n], &a = vertices_[i], &q = vertices_[(i + 1) % n];
      const double area = std::abs(cross(minus(a, p), minus(q, p)));
      if (i == 0 || area < least) {
        least = area;
        best = i;
      }
    }
    vertices_.erase(vertices_.begin() + static_cast<std::ptrdiff_t>(best));
  }
}

void ControllableSet::cut(double x, double v, double most) {
  const std::size_t n = vertices_.size();
  const auto beyond = [&](const State& s) { return x * s[0] + v * s[1] - most; };
  if (std::none_of(vertices_.begin(), vertices_.end(), [&](const State& s) { return beyond(s) > 0; })) return;
  spare_.clear();
  double from = beyond(vertices_.front());
  for (std::size_t i = 0; i < n; ++i) {
    const State &a = vertices_[i], &b = vertices_[i + 1 < n ? i + 1 : 0];
    const double to = beyond(b);
    if (from <= 0) spare_.push_back(a);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
      const double share = from / (from - to);
      spare_.push_back({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])});
    }
    from = to;
  }
  std::swap(vertices_, spare_);
}

void ControllableSet::limit(const std::array<Range, 2>& boxes) {
  if (empty()) return;
  Range x{vertices_.front()[0], vertices_.front()[0]}, v{vertices_.front()[1], vertices_.front()[1]};
  for (const State& s : vertices_) {
    x = {std::min(x.lowest, s[0]), std::max(x.highest, s[0])};
    v = {std::min(v.lowest, s[1]), std::max(v.highest, s[1])};
  }
  // In most cases no vertex is beyond the line.
  if (x.highest > boxes[0].highest) cut(1, 0, boxes[0].highest);
  if (x.lowest < boxes[0].lowest) cut(-1, 0, -boxes[0].lowest);
  if (v.highest > boxes[1].highest) cut(0, 1, boxes[1].highest);
  if (v.lowest < boxes[1].lowest) cut(0, -1, -boxes[1].lowest);
}

bool ControllableSet::meets(const ControllableSet& other) const {
  ControllableSet both = *this;
  const std::size_t n = other.vertices_.size();
  if (n == 0) return false;
  for (std::size_t i = 0; i < n && !both.empty(); ++i) {
    const State &a = other.vertices_[i], edge = minus(other.vertices_[i + 1 < n ? i + 1 : 0], a);
    both.cut(edge[1], -edge[0], edge[1] * a[0] - edge[0] * a[1]);
  }
  return !both.empty();
}

ControllableSet followed_forward(ControllableSet states, const Chain<2>& chain, std::size_t first, std::size_t last) {
  for (std::size_t c = first; c < last && !states.empty(); ++c) {
    states.advance(chain.steps[c], chain.controls[c]);
    if (c + 1 < chain.cells() || !chain.ends_at_rest) states.limit(chain.states[c + 1]);
  }
  return states;
}

ControllableSet followed_backward(ControllableSet states, const Chain<2>& chain, std::size_t first, std::size_t last) {
  for (std::size_t c = last; c-- > first && !states.empty();) {
    states.advance(-chain.steps[c], chain.controls[c]);
    if (c > 0 || !chain.begins_at_rest) states.limit(chain.states[c]);
  }
  return states;
}

std::vector<std::pair<std::size_t, std::size_t>> conflicts(const Chain<2>& chain, const std::function<void()>& tick) {
  constexpr std::size_t often = 1024;
  const std::size_t n = chain.cells();
  const auto at = [&](std::size_t node) {
    const bool rests = (node == 0 && chain.begins_at_rest) || (node == n && chain.ends_at_rest);
    return ControllableSet::at_node(chain.states[node], rests);
  };
  // Advances one cell forward or backward. The states at rest are a segment without interior, so the other set is cut
  // by the boxes, not this one by the other set.
  const auto carried = [&](ControllableSet& states, std::size_t cell, bool forward) {
    const double h = forward ? chain.steps[cell] : -chain.steps[cell];
    const std::size_t node = forward ? cell + 1 : cell;
    states.advance(h, chain.controls[cell]);
    if (forward && node == n && chain.ends_at_rest) return at(n).meets(states);
    if (!forward && node == 0 && chain.begins_at_rest) return at(0).meets(states);
    states.limit(chain.states[node]);
    return !states.empty();
  };
  std::vector<std::pair<std::size_t, std::size_t>> found;
  ControllableSet states = at(0);
  std::size_t from = 0;  // where the states are what the boxes allow
  for (std::size_t c = 0; c < n; ++c) {
    if (tick && c % often == 0) tick();
    if (carried(states, c, true)) continue;
    const std::size_t last = c + 1;
    std::size_t first = last;
    for (ControllableSet back = at(last); first > 0;)
      if (!carried(back, --first, false)) break;
    found.emplace_back(first, last);
    // A conflict that begins inside this interval may end later; if it does not, because of rounding, the search goes
    // on behind it.
    from = found.size() > 1 && last <= found[found.size() - 2].second ? last : first + (last - first) / 2 + 1;
    states = at(from);
    c = from - 1;
  }
  return found;
}

}  // namespace bahnwerk
