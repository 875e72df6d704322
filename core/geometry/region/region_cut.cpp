// Offsets and differences of regions: edges are split where they meet, the parts that bound the result are selected and
// joined.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/region/crossings.hpp"
#include "core/geometry/region/region.hpp"
#include "core/numeric/bisection.hpp"

namespace bahnwerk {
namespace {

constexpr double joint = 1e-6;            // mm, ends this close are one
constexpr double min_edge_length = 1e-9;  // mm, shorter parts are rounding
constexpr double reach_margin = 1e-8;     // mm, what lacks no more is not given up before it is cut
constexpr double together = 2e-9;         // mm, edges no further apart have nothing between them
constexpr Box nowhere{{1e300, 1e300}, {-1e300, -1e300}};

/// The parts into which meetings cut every edge.
std::vector<Edge> split(const std::vector<Edge>& edges, const std::vector<std::vector<double>>& cuts) {
  std::vector<Edge> parts;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    std::vector<double> at = cuts[i];
    at.push_back(0);
    at.push_back(1);
    std::sort(at.begin(), at.end());
    const double least = min_edge_length / edges[i].length();
    double last = 0;
    for (const double f : at) {
      if (f - last < least) continue;
      parts.push_back(edges[i].part(last, f));
      last = f;
    }
  }
  return parts;
}

/// Returns whether `end`, where another edge has the direction `along`, lies on `edge` and that edge has the opposite
/// direction there.
bool runs_back(const Edge& edge, Point end, Point along, double& at) {
  at = edge.nearest(end);
  return distance(edge.at(at), end) <= together && dot(edge.direction(at), along) < -1 + 1e-9;
}

/// Removes the parts that run back over each other, as where the region is twice the depth wide: they bound no area.
std::vector<Edge> without_lines(std::vector<Edge> parts, Progress progress) {
  std::vector<std::vector<double>> cuts(parts.size());
  const auto each_pair = [&](auto visit) {
    std::vector<Box> boxes;
    for (const Edge& part : parts) boxes.push_back(extent(part, together));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i % 64 == 0) progress.report("parallels", 0);
      for (std::size_t k = i + 1; k < parts.size(); ++k)
        if (boxes[i].low.x <= boxes[k].high.x && boxes[k].low.x <= boxes[i].high.x &&
            boxes[i].low.y <= boxes[k].high.y && boxes[k].low.y <= boxes[i].high.y)
          visit(i, k);
    }
  };
  bool any = false;
  const auto cut = [&](std::size_t i, const Edge& other) {
    double at = 0;
    for (const double end : {0.0, 1.0})
      if (runs_back(parts[i], other.at(end), other.direction(end), at)) {
        cuts[i].push_back(at);
        any = true;
      }
  };
  each_pair([&](std::size_t i, std::size_t k) {
    cut(i, parts[k]);
    cut(k, parts[i]);
  });
  if (!any) return parts;
  parts = split(parts, cuts);
  std::vector<char> dropped(parts.size());
  each_pair([&](std::size_t i, std::size_t k) {
    const Edge &a = parts[i], &b = parts[k];
    double at = 0;
    if (dropped[i] || dropped[k] || distance(a.from, b.to) > joint || distance(a.to, b.from) > joint) return;
    if (runs_back(a, b.at(0.5), b.direction(0.5), at)) dropped[i] = dropped[k] = 1;
  });
  std::vector<Edge> left;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!dropped[i]) left.push_back(parts[i]);
  return left;
}

/// Removes parts without a predecessor or successor. At a shallow corner the parallels extend past their crossing for
/// some 1e-6 mm before they are distinguishable from the bounds of the result.
void drop_tails(std::vector<Edge>& parts, Progress progress) {
  for (bool dropped = true; dropped;) {
    std::vector<char> led_to(parts.size()), leads_on(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i % 64 == 0) progress.report("parallels", 0);
      for (std::size_t k = 0; k < parts.size(); ++k)
        if ((i != k || !parts[i].straight()) && distance(parts[i].to, parts[k].from) < joint)
          leads_on[i] = led_to[k] = 1;
    }
    std::size_t left = 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (led_to[i] && leads_on[i]) parts[left++] = parts[i];
    dropped = left < parts.size();
    parts.resize(left);
  }
}

/// Loops of positive area made of parts that lie end to end.
std::vector<Edge> joined(std::vector<Edge> parts, Progress progress) {
  drop_tails(parts, progress);
  std::vector<Edge> edges;
  std::vector<char> used(parts.size());
  for (std::size_t start = 0; start < parts.size(); ++start) {
    if (used[start]) continue;
    std::vector<Edge> loop{parts[start]};
    used[start] = 1;
    bool closed = false;
    while (!closed) {
      if (loop.size() % 64 == 0) progress.report("parallels", 0);
      const Point end = loop.back().to;
      closed = distance(end, loop.front().from) < joint && (loop.size() > 1 || !loop.back().straight());
      if (closed) break;
      std::size_t next = parts.size();
      double nearest = joint;
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (const double gap = distance(parts[i].from, end); !used[i] && gap < nearest) {
          nearest = gap;
          next = i;
        }
      if (next == parts.size()) break;
      used[next] = 1;
      loop.push_back(parts[next]);
    }
    double doubled = 0;
    const Point origin =
        loop.front().from;  // origin at a point of the loop: far from (0, 0) rounding would make an area
    for (Edge edge : loop) {
      edge.from -= origin;
      edge.to -= origin;
      doubled += edge.doubled_area();
    }
    if (closed && doubled > 1e-9) edges.insert(edges.end(), loop.begin(), loop.end());
  }
  return edges;
}

}  // namespace

std::vector<Edge> Region::parallels(double depth) const {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Edge& edge = edges_[i];
    if (depth > 0 ? juts_at(i) : recedes_at(i)) {
      const Point in = left_of(edges_[before_[i]].direction(1)), out = left_of(edge.direction(0));
      edges.push_back(arc_between(edge.from, edge.from + depth * in, edge.from + depth * out, depth < 0));
    }
    Edge shifted = edge;
    shifted.from += depth * left_of(edge.direction(0));
    shifted.to += depth * left_of(edge.direction(1));
    if (!edge.straight()) shifted.radius += edge.turn > 0 ? -depth : depth;
    if (edge.straight() || shifted.radius > min_edge_length) edges.push_back(shifted);
  }
  return edges;
}

double Region::first_reached(const Edge& parallel, double depth) const {
  double from = 0;
  for (int step = 0; step < 100 && from < 1; ++step) {
    const Nearest nearest = this->nearest(parallel.at(from));
    if (nearest.distance >= depth - reach_margin) return from;
    // The part too near to one straight edge is an interval: the distance from a convex set is convex along a line.
    const Edge& edge = edges_[nearest.edge];
    if (!edge.straight() || nearest.distance < 0) return from;
    const auto near = [&](double f) {
      const Point p = parallel.at(f);
      return bahnwerk::distance(edge.at(edge.nearest(p)), p) < depth - reach_margin;
    };
    if (near(1)) return 1;
    const double last = bisect(from, 1, 0, 50, near).low;
    if (last <= from) return from;
    from = last;
  }
  return from;
}

std::vector<Box> Region::reached(const std::vector<Edge>& parallels, double depth, Progress progress) const {
  std::vector<Box> boxes;
  for (const Edge& edge : parallels) {
    if (boxes.size() % 64 == 0) progress.report("parallels", 0);
    double first = 0, last = 1;
    if (depth > 0 && edge.straight()) {
      first = first_reached(edge, depth);
      last = first < 1 ? 1 - first_reached(edge.reversed(), depth) : 0;
    }
    boxes.push_back(first < 1 ? extent(edge.part(first, std::max(first, last)), reach_margin) : nowhere);
  }
  return boxes;
}

Region Region::inward(double depth, Progress progress) const {
  if (depth == 0 || empty()) return *this;
  const std::vector<Edge> edges = parallels(depth);
  std::vector<std::vector<double>> cuts(edges.size());
  const auto cut = [&](std::size_t i, std::size_t k, const Meeting& m) {
    cuts[i].push_back(m.first);
    cuts[k].push_back(m.second);
  };
  each_meeting(edges, cut, edges.size() < many_edges ? std::vector<Box>{} : reached(edges, depth, progress));
  std::vector<Edge> parts = split(edges, cuts);
  std::size_t seen = 0;
  std::erase_if(parts, [&](const Edge& part) {
    if (++seen % 512 == 0) progress.report("parallels", 0);
    return std::abs(distance(part.at(0.5)) - depth) > 1e-9;
  });
  return Region(joined(without_lines(std::move(parts), progress), progress));
}

Region Region::without(const Region& other) const {
  std::vector<std::vector<double>> mine(edges_.size()), theirs(other.edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i)
    for (std::size_t k = 0; k < other.edges_.size(); ++k)
      for (const Meeting& m : meetings(edges_[i], other.edges_[k])) {
        mine[i].push_back(m.first);
        theirs[k].push_back(m.second);
      }
  std::vector<Edge> parts = split(edges_, mine);
  std::erase_if(parts, [&](const Edge& part) { return other.distance(part.at(0.5)) > 0; });
  for (const Edge& part : split(other.edges_, theirs))
    if (distance(part.at(0.5)) > 0) parts.push_back(part.reversed());
  return Region(joined(std::move(parts), {}));
}

}  // namespace bahnwerk
