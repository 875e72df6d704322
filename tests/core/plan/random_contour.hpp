#pragma once
/// Random contours as lists of segments, so that they can be reversed, scaled and cut before they are built.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/contour/builder.hpp"
#include "core/machine/machine.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::testing {

struct Shape {
  enum Kind { line, arc, polynomial, nurbs } kind = line;
  Vec from, to, centre;
  bool counter_clockwise = true;
  std::vector<Vec> points;  // polynomial: Bézier control points; nurbs: control points
  std::vector<double> weights, knots;
  int degree = 3;
};

struct Outline {
  std::size_t dimension = 2;
  std::vector<Shape> shapes;
  std::vector<double> feeds;  // per shape; a block for each run of equal feeds
};

inline double binomial(std::size_t n, std::size_t k) {
  double b = 1;
  for (std::size_t i = 0; i < k; ++i) b = b * static_cast<double>(n - i) / static_cast<double>(i + 1);
  return b;
}

/// Power-basis rows of a Bézier curve.
inline std::vector<std::vector<double>> power_basis(const std::vector<Vec>& p, std::size_t dimension) {
  const std::size_t n = p.size() - 1;
  std::vector<std::vector<double>> rows(dimension, std::vector<double>(n + 1));
  for (std::size_t d = 0; d < dimension; ++d)
    for (std::size_t j = 0; j <= n; ++j) {
      double sum = 0;
      for (std::size_t i = 0; i <= j; ++i) sum += ((i + j) % 2 ? -1 : 1) * binomial(j, i) * p[i][d];
      rows[d][j] = binomial(n, j) * sum;
    }
  return rows;
}

inline Contour build(const Outline& outline) {
  ContourBuilder builder(outline.dimension, outline.shapes.front().from);
  double feed = -1;
  for (std::size_t i = 0; i < outline.shapes.size(); ++i) {
    const Shape& s = outline.shapes[i];
    if (outline.feeds[i] != feed) builder.block(i % 3 ? Mode::cut : Mode::position, feed = outline.feeds[i]);
    switch (s.kind) {
      case Shape::line:
        builder.line(s.to);
        break;
      case Shape::arc:
        builder.arc(s.to, s.centre, s.counter_clockwise);
        break;
      case Shape::polynomial:
        builder.polynomial(power_basis(s.points, outline.dimension));
        break;
      case Shape::nurbs:
        builder.nurbs(s.degree, s.points, s.weights, s.knots);
        break;
    }
  }
  return builder.finish();
}

inline Outline reversed(Outline o) {
  std::reverse(o.shapes.begin(), o.shapes.end());
  std::reverse(o.feeds.begin(), o.feeds.end());
  for (Shape& s : o.shapes) {
    std::swap(s.from, s.to);
    s.counter_clockwise = !s.counter_clockwise;
    std::reverse(s.points.begin(), s.points.end());
    std::reverse(s.weights.begin(), s.weights.end());
    std::reverse(s.knots.begin(), s.knots.end());
    for (double& k : s.knots) k = 1 - k;
  }
  return o;
}

inline Outline scaled(Outline o, double factor) {
  for (Shape& s : o.shapes) {
    s.from = factor * s.from;
    s.to = factor * s.to;
    s.centre = factor * s.centre;
    for (Vec& p : s.points) p = factor * p;
  }
  for (double& f : o.feeds) f *= factor;
  return o;
}

/// Cuts every line into collinear pieces and every arc (but nearly full ones, whose centre rounding decides about) into
/// pieces about the same centre.
inline Outline divided(const Outline& o, Random& random) {
  Outline out{o.dimension, {}, {}};
  for (std::size_t i = 0; i < o.shapes.size(); ++i) {
    const Shape& s = o.shapes[i];
    Shape a = s, b = s;
    const double share = random.uniform(0.05, 0.95);
    if (s.kind == Shape::line) {
      a.to = b.from = s.from + share * (s.to - s.from);
    } else if (s.kind == Shape::arc && o.dimension == 2 && norm(s.to - s.from) > 0.1 * norm(s.to - s.centre)) {
      const Vec p = s.from - s.centre, q = s.to - s.centre;
      double sweep = std::atan2(cross(p, q).z, dot(p, q));
      if (s.counter_clockwise && sweep <= 1e-9) sweep += 2 * M_PI;
      if (!s.counter_clockwise && sweep >= -1e-9) sweep -= 2 * M_PI;
      const double w = share * sweep;
      a.to = b.from = s.centre + Vec{std::cos(w) * p.x - std::sin(w) * p.y, std::sin(w) * p.x + std::cos(w) * p.y, 0};
    } else {
      out.shapes.push_back(s);
      out.feeds.push_back(o.feeds[i]);
      continue;
    }
    out.shapes.push_back(a);
    out.shapes.push_back(b);
    out.feeds.insert(out.feeds.end(), 2, o.feeds[i]);
  }
  return out;
}

inline Vec direction(double w) { return {std::cos(w), std::sin(w), 0}; }

/// `count` segments; about half of the joints are tangential, some nearly, some reverse; sizes over several decades.
inline Outline random_outline(Random& random, std::size_t count, std::size_t dimension) {
  Outline o;
  o.dimension = dimension;
  Vec at{random.uniform(-100, 100), random.uniform(-100, 100), 0};
  double heading = random.uniform(-3, 3);
  double feed = unlimited;
  const double scale = std::pow(10, random.uniform(-1, 2));
  for (std::size_t i = 0; i < count; ++i) {
    if (random.chance(0.3)) feed = random.chance(0.3) ? unlimited : std::pow(10, random.uniform(0.5, 3.2));
    const double kink = random.uniform();
    if (kink < 0.3)
      heading += random.uniform(-3, 3);
    else if (kink < 0.4)
      heading += random.uniform(-2e-3, 2e-3);
    else if (kink < 0.43)
      heading += M_PI;
    Shape s;
    s.from = at;
    double size = scale * std::pow(10, random.uniform(-1, 0.5));
    if (random.chance(0.05)) size = std::pow(10, random.uniform(-4, -2));
    const double pick = random.uniform();
    const double climb = dimension == 3 ? random.uniform(-0.5, 0.5) * size : 0;
    if (pick < 0.35) {
      s.kind = Shape::line;
      s.to = at + size * direction(heading) + Vec{0, 0, climb};
    } else if (pick < 0.7) {
      s.kind = Shape::arc;
      s.counter_clockwise = random.chance(0.5);
      const double side = s.counter_clockwise ? 1 : -1,
                   sweep = side * (random.chance(0.1) ? 2 * M_PI : random.uniform(0.05, 6));
      s.centre = at + size * direction(heading + side * M_PI / 2);
      const Vec r = at - s.centre;
      s.to = std::abs(sweep) > 6.2 ? at
                                   : s.centre + Vec{std::cos(sweep) * r.x - std::sin(sweep) * r.y,
                                                    std::sin(sweep) * r.x + std::cos(sweep) * r.y, 0};
      s.to.z = at.z + climb;
      s.centre.z = at.z;
      heading += sweep;
    } else {
      s.kind = pick < 0.88 ? Shape::polynomial : Shape::nurbs;
      const std::size_t n = s.kind == Shape::polynomial ? 3 + random.below(3) : 5 + random.below(6);
      Vec p = at;
      s.points.push_back(p);
      double w = heading;
      for (std::size_t j = 1; j < n; ++j) {
        p = p + random.uniform(0.3, 1) * size * direction(w) +
            Vec{0, 0, dimension == 3 ? random.uniform(-0.3, 0.3) * size : 0};
        s.points.push_back(p);
        w += random.uniform(-1, 1);
      }
      const Vec last = s.points[n - 1] - s.points[n - 2];
      heading = std::atan2(last.y, last.x);
      s.to = p;
      if (s.kind == Shape::nurbs) {
        s.degree = 3;
        const std::size_t inner = n - 4;
        s.knots.assign(4, 0);
        std::vector<double> knots;
        for (std::size_t j = 0; j < inner; ++j) knots.push_back(random.uniform(0.05, 0.95));
        std::sort(knots.begin(), knots.end());
        s.knots.insert(s.knots.end(), knots.begin(), knots.end());
        s.knots.insert(s.knots.end(), 4, 1);
        for (std::size_t j = 0; j < n; ++j) s.weights.push_back(random.chance(0.5) ? 1 : random.uniform(0.3, 3));
      }
    }
    at = s.to;
    o.shapes.push_back(s);
    o.feeds.push_back(feed);
  }
  return o;
}

inline Machine random_machine(Random& random, std::size_t dimension) {
  static const char* names[] = {"x", "y", "z"};
  Machine m;
  m.cycle_time = random.chance(0.5) ? 0.001 : std::pow(10, random.uniform(-4, -2));
  for (std::size_t k = 0; k < dimension; ++k) {
    AxisLimits a;
    a.name = names[k];
    a.velocity = random.chance(0.1) ? unlimited : std::pow(10, random.uniform(1, 3.5));
    a.acceleration = std::pow(10, random.uniform(2, 4.5));
    m.axes.push_back(a);
  }
  if (random.chance(0.4))
    for (AxisLimits& a : m.axes) {
      const std::string name = a.name;
      a = m.axes[0];
      a.name = name;
    }
  return m;
}

}  // namespace bahnwerk::testing
