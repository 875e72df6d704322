#pragma once
/// What the tests hold the verifier and the bound against: contours by hand, a law by hand, and a slow dense solution
/// of the acceleration-limited problem that shares no formula with the bound.
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "core/contour/contour.hpp"
#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk::reference {

/// Puts curves end to end; each call of block() begins a new block.
class Maker {
 public:
  explicit Maker(std::size_t dimension = 2, Vec start = {}) : position_(start) { contour_.dimension = dimension; }
  Maker& block(double feed) {
    contour_.blocks.push_back({Mode::cut, feed, contour_.path.size(), contour_.path.size()});
    return *this;
  }
  Maker& line(Vec to) { return add(std::make_shared<Line>(position_, to), to); }
  Maker& arc(Vec to, Vec centre, bool ccw) {
    return add(std::make_shared<Arc>(Arc::through(position_, to, centre, {0, 0, 1}, ccw)), to);
  }
  /// Bézier curve from the current point.
  Maker& bezier(std::vector<Vec> points, const std::vector<double>& weights = {}) {
    points.insert(points.begin(), position_);
    return add(std::make_shared<Rational>(Rational::bezier(points, weights)), points.back());
  }
  Vec position() const { return position_; }
  Vec direction() const {
    const Segment& last = contour_.path[contour_.path.size() - 1];
    return last.at_parameter(last.curve().end()).d1;
  }
  Contour done() { return contour_; }

 private:
  Maker& add(const std::shared_ptr<const Curve>& curve, Vec to) {
    if (contour_.blocks.empty()) block(unlimited);
    contour_.path.append(curve, contour_.path.size());
    contour_.blocks.back().last = contour_.path.size();
    position_ = to;
    return *this;
  }
  Contour contour_;
  Vec position_;
};

inline Machine machine(std::size_t axes, double velocity, double acceleration, double cycle = 0.001) {
  Machine m;
  for (std::size_t k = 0; k < axes; ++k)
    m.axes.push_back({std::string(1, "xyz"[k]), velocity, acceleration, unlimited});
  m.cycle_time = cycle;
  return m;
}

/// Line, full circle of radius r, line: all tangent.
inline Contour circle_between_lines(double r = 10, double feed = unlimited) {
  return Maker().block(feed).line({50, 0}).arc({50, 0}, {50, r}, true).line({100, 0}).done();
}

/// Random contour of lines, arcs and Bézier pieces: some joints smooth, some corners.
inline Contour random_contour(std::mt19937_64& random, int segments, bool smooth, double feed = unlimited) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Maker make(2, {uniform(random) * 100, uniform(random) * 100});
  make.block(feed);
  make.line(make.position() + Vec{10 * uniform(random) + 11, 10 * uniform(random), 0});
  for (int i = 1; i < segments; ++i) {
    const double size = std::pow(10, 1.2 * uniform(random) + 0.3), turn = smooth ? 0 : 3 * uniform(random);
    const Vec p = make.position(), t = make.direction();
    const Vec d{t.x * std::cos(turn) - t.y * std::sin(turn), t.x * std::sin(turn) + t.y * std::cos(turn), 0},
        n{-d.y, d.x, 0};
    const int kind = static_cast<int>(random() % 3);
    if (kind == 0) {
      make.line(p + size * d);
    } else if (kind == 1) {
      const double sweep = 1.6 + 1.5 * uniform(random), side = random() % 2 ? 1 : -1;
      const Vec c = p + side * size * n;
      make.arc(c + size * std::sin(sweep) * d - side * size * std::cos(sweep) * n, c, side > 0);
    } else {
      std::vector<Vec> q{p + size * d};
      std::vector<double> w{1, 1};
      const int degree = 3 + static_cast<int>(random() % 3);
      for (int k = 2; k <= degree; ++k) {
        q.push_back(q.back() + size * Vec{uniform(random), uniform(random), 0} + 0.6 * size * d);
        w.push_back(1 + 0.6 * uniform(random));
      }
      make.bezier(q, random() % 2 ? w : std::vector<double>{});
    }
  }
  return make.done();
}

/// Time-optimal duration by reachable sets on an even grid of each curve's parameter [Pham, Pham: A new approach to
/// time-optimal path parameterization based on reachability analysis, IEEE T-RO 34, 2018]: constraints hold at grid
/// points only, error O(1/cells).
inline double dense_optimum(const Contour& contour, const Machine& machine, double corner_angle,
                            std::size_t cells_per_segment) {
  struct Node {
    PathPoint h;
    double cap, ds;
  };
  std::vector<Node> g;
  const std::vector<double> feed = contour.feeds();
  const std::vector<Joint> joint = joints(contour.path);
  const std::size_t axes = machine.axes.size();
  for (std::size_t i = 0; i < contour.path.size(); ++i) {
    const Segment& segment = contour.path[i];
    for (std::size_t c = 0; c <= cells_per_segment; ++c) {
      const double f = double(c) / double(cells_per_segment);
      const double u0 = segment.curve().begin(), du = segment.curve().end() - u0,
                   next = double(c + 1) / double(cells_per_segment);
      const double u = u0 + f * du;
      Node n{segment.at_parameter(u), feed[i] * feed[i], segment.arc_length(u0 + next * du) - segment.arc_length(u)};
      for (std::size_t k = 0; k < axes; ++k)
        n.cap = std::min(n.cap, std::pow(machine.axes[k].velocity / std::max(1e-9, std::abs(n.h.d1[k])), 2));
      if ((c == 0 && segment.cusp_begin()) || (c == cells_per_segment && segment.cusp_end())) n.cap = 0;
      auto at_joint = [&](const Joint& j) {
        if (j.angle > corner_angle) n.cap = 0;
        for (std::size_t k = 0; k < axes; ++k)
          if (j.step[k] != 0)
            n.cap = std::min(n.cap, std::pow(machine.axes[k].acceleration * machine.cycle_time / j.step[k], 2));
      };
      if (c == 0 && i > 0) at_joint(joint[i - 1]);
      if (c == cells_per_segment) {
        n.ds = 0;
        if (i + 1 < contour.path.size()) at_joint(joint[i]);
      }
      g.push_back(n);
    }
  }
  g.front().cap = g.back().cap = 0;
  // Lower and upper lines a = m b + c at a node, next speed² ≤ next.
  struct Line2 {
    double m, c;
  };
  std::vector<Line2> low, high;
  auto lines = [&](const Node& n, double next) {
    low.clear(), high.clear();
    for (std::size_t k = 0; k < axes; ++k) {
      const double t = n.h.d1[k], q = n.h.d2[k], A = machine.axes[k].acceleration;
      if (std::abs(t) < 1e-14) continue;
      low.push_back({-q / t, -A / std::abs(t)}), high.push_back({-q / t, A / std::abs(t)});
    }
    if (n.ds > 0) high.push_back({-1 / (2 * n.ds), next / (2 * n.ds)}), low.push_back({-1 / (2 * n.ds), 0});
  };
  std::vector<double> reach(g.size());
  for (std::size_t i = g.size(); i-- > 0;) {
    const double next = i + 1 < g.size() ? reach[i + 1] : 0;
    double b = g[i].cap;
    if (g[i].ds == 0 && i + 1 < g.size()) b = std::min(b, next);
    for (std::size_t k = 0; k < axes; ++k)
      if (std::abs(g[i].h.d1[k]) < 1e-14 && g[i].h.d2[k] != 0)
        b = std::min(b, machine.axes[k].acceleration / std::abs(g[i].h.d2[k]));
    lines(g[i], next);
    for (const Line2& l : low)
      for (const Line2& h : high)
        if (l.m > h.m) b = std::min(b, (h.c - l.c) / (l.m - h.m));
    reach[i] = std::max(b, 0.0);
  }
  double b = 0, time = 0;
  for (std::size_t i = 0; i + 1 < g.size(); ++i) {
    if (g[i].ds == 0) continue;
    lines(g[i], reach[i + 1]);
    double a = 1e300;
    for (const Line2& h : high) a = std::min(a, h.m * b + h.c);
    const double next = std::clamp(b + 2 * a * g[i].ds, 0.0, reach[i + 1]);
    if (b + next > 0) time += 2 * g[i].ds / (std::sqrt(b) + std::sqrt(next));
    b = next;
  }
  return time;
}

/// A law from speeds at places: constant acceleration in between, every place that separates segments among them.
struct Stop {
  double s, v;
};
inline TimeLaw law_through(const Path& path, const std::vector<Stop>& stops) {
  TimeLaw law;
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const Stop &p = stops[i - 1], &q = stops[i];
    LawPiece piece;
    piece.duration = 2 * (q.s - p.s) / (p.v + q.v);
    piece.s = p.s, piece.s_end = q.s, piece.v = p.v;
    piece.a = (q.v * q.v - p.v * p.v) / (2 * (q.s - p.s));
    piece.segment = path.find((p.s + q.s) / 2);
    law.append(piece);
  }
  return law;
}

}  // namespace bahnwerk::reference
