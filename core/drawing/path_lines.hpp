#pragma once
/// Polylines of a path for drawings: sampling of curves within a tolerance, and thinning of lines to what is visible.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <unordered_set>
#include <utility>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/path/path.hpp"
#include "core/geometry/region/point.hpp"

namespace bahnwerk::drawing {

/// Calls `to` with points of a segment whose chords stay within `tolerance`, mm, of it; the segment's begin is left
/// out.
class Sampler {
 public:
  Sampler(double tolerance, const std::function<void(Vec)>& to) : tolerance_(tolerance), to_(to) {}
  void operator()(const Segment& segment) {
    const Curve& curve = segment.curve();
    if (segment.straight() || segment.length() <= 2 * tolerance_) return to_(curve.at(curve.end()).value);
    if (curve.kind() == CurveKind::arc) {
      const double sweep = std::abs(static_cast<const Arc&>(curve).sweep()), radius = segment.length() / sweep;
      const double step = 2 * std::acos(std::max(0.5, 1 - tolerance_ / radius));
      const int n = std::max(1, static_cast<int>(std::ceil(sweep / step)));
      for (int i = 1; i <= n; ++i) to_(curve.at(i == n ? curve.end() : at(curve, i, n)).value);
      return;
    }
    double u = curve.begin();
    Vec p = curve.at(u).value;
    for (const double end : segment.panel_parameters()) {
      if (!(end > u)) continue;
      const Vec q = curve.at(end).value;
      between(curve, {u, p}, {end, q}, curve.at(u + (end - u) / 2).value, 0);
      u = end, p = q;
    }
  }

 private:
  static constexpr int deepest = 12;
  static double at(const Curve& curve, int i, int n) { return curve.begin() + (curve.end() - curve.begin()) * i / n; }
  /// Returns the distance from the line through a and b, or from a if they are equal.
  static double off(Vec p, Vec a, Vec b) {
    const Vec way = b - a;
    const double length = norm(way);
    return length > 0 ? norm(cross(way, p - a)) / length : norm(p - a);
  }
  /// A point of a curve with its parameter.
  struct Sample {
    double u;
    Vec p;
  };
  /// Calls `to` with the points behind `a` up to `b`; `middle` is the point in the middle of their parameters.
  void between(const Curve& curve, const Sample& a, const Sample& b, Vec middle, int depth) {
    const double width = b.u - a.u;
    const Vec first = curve.at(a.u + width / 4).value, third = curve.at(a.u + width * 3 / 4).value;
    const double bulge = std::max({off(middle, a.p, b.p), off(first, a.p, b.p), off(third, a.p, b.p)});
    if (depth >= deepest || bulge <= tolerance_ / 2) {
      to_(middle);
      return to_(b.p);
    }
    const Sample half{a.u + width / 2, middle};
    between(curve, a, half, first, depth + 1);
    between(curve, half, b, third, depth + 1);
  }

  double tolerance_;
  const std::function<void(Vec)>& to_;
};

/// Builds SVG path data of many lines with fewer points: a point is left out while one straight line passes all points
/// since the last kept one within half of the tolerance, px. Points are rounded to a lattice of a third of the
/// tolerance, and no line is drawn twice.
class Thinned {
 public:
  explicit Thinned(double tolerance) : reach_(tolerance / 2), lattice_(tolerance / 3) {}

  void begin(Point p) {
    end();
    anchor_ = last_ = p;
    open_ = true;
    low_ = -HUGE_VAL, high_ = HUGE_VAL, farthest_ = 0;
  }
  void to(Point p) {
    if (!fits(p)) {
      line(anchor_, last_);
      anchor_ = last_;
      low_ = -HUGE_VAL, high_ = HUGE_VAL, farthest_ = 0;
      fits(p);
    }
    last_ = p;
  }
  void end() {
    if (open_) line(anchor_, last_);
    open_ = false;
    pen_ = nowhere;
  }
  /// Returns the path data in units of lattice(), px.
  const std::string& data() const { return data_; }
  double lattice() const { return lattice_; }

 private:
  using Place = std::pair<std::int32_t, std::int32_t>;
  static constexpr Place nowhere{INT32_MIN, INT32_MIN};

  /// Tells whether the line from the anchor to p passes all points since; restricts the directions of later ones.
  bool fits(Point p) {
    const double dx = p.x - anchor_.x, dy = p.y - anchor_.y, d = std::hypot(dx, dy);
    if (d < farthest_ - reach_) return false;  // the path has turned back
    if (d <= reach_) {
      farthest_ = std::max(farthest_, d);
      return true;
    }
    double angle = std::atan2(dy, dx);
    const double half = std::asin(reach_ / d);
    if (low_ > -HUGE_VAL) {
      const double turn = 2 * std::numbers::pi, middle = (low_ + high_) / 2;
      angle -= turn * std::round((angle - middle) / turn);
      if (angle < low_ || angle > high_) return false;
    }
    low_ = std::max(low_, angle - half), high_ = std::min(high_, angle + half);
    farthest_ = std::max(farthest_, d);
    return true;
  }
  Place place(Point p) const {
    return {static_cast<std::int32_t>(std::lround(p.x / lattice_)),
            static_cast<std::int32_t>(std::lround(p.y / lattice_))};
  }
  void line(Point from, Point to) {
    Place a = place(from), b = place(to);
    const auto key = [](Place p) { return (static_cast<std::uint64_t>(p.first & 0xFFFF) << 16) | (p.second & 0xFFFF); };
    const std::uint64_t one = key(a), other = key(b);
    if (!drawn_.insert(std::min(one, other) << 32 | std::max(one, other)).second) return;
    char text[48];
    if (a != pen_) {
      std::snprintf(text, sizeof text, "M%d %dl", a.first, a.second);
      data_ += text;
    } else if (b.first >= a.first) {
      data_ += ' ';  // a minus sign separates by itself
    }
    const int dx = b.first - a.first, dy = b.second - a.second;
    std::snprintf(text, sizeof text, dy < 0 ? "%d%d" : "%d %d", dx, dy);
    data_ += text;
    pen_ = b;
  }

  double reach_, lattice_;  // px
  std::string data_;
  std::unordered_set<std::uint64_t> drawn_;
  Place pen_ = nowhere;
  Point anchor_{}, last_{};
  double low_ = 0, high_ = 0, farthest_ = 0;
  bool open_ = false;
};

}  // namespace bahnwerk::drawing
