// SPLINE: control points, weights and knots as they stand; with fit points alone the cubic spline through them.
#include <algorithm>
#include <cmath>

#include "core/contour/dxf/read/entity.hpp"
#include "core/numeric/tridiagonal.hpp"

namespace bahnwerk {
namespace {

/// The cubic spline with continuous curvature through the points, over the length of its chords; ends with the given
/// tangents, or straight (natural) where none is given; closed: periodic. [de Boor: A Practical Guide to Splines, IV]
DrawnSpline through(std::vector<Vec> p, bool closed, Vec start_tangent, Vec end_tangent) {
  double whole = 0;
  for (std::size_t i = 1; i < p.size(); ++i) whole += norm(p[i] - p[i - 1]);
  if (closed) p.push_back(p.front());
  p.erase(std::unique(p.begin(), p.end(), [&](Vec a, Vec b) { return norm(a - b) <= 1e-12 * whole; }), p.end());
  if (p.size() < 2) return {};
  const std::size_t spans = p.size() - 1;
  closed = closed && spans > 2;
  std::vector<double> h(spans);
  for (std::size_t i = 0; i < spans; ++i) h[i] = norm(p[i + 1] - p[i]);
  const std::size_t n = closed ? spans : spans + 1;  // unknown slopes
  Tridiagonal matrix(n);
  std::vector<Vec> slope(n);  // slopes; at first the right side of their system
  for (std::size_t i = 0; i < n; ++i) {
    if (!closed && (i == 0 || i == spans)) {
      const Vec tangent = i == 0 ? start_tangent : end_tangent;
      const std::size_t side = i == 0 ? 0 : spans - 1;
      if (norm(tangent) > 0) {
        slope[i] = tangent / norm(tangent);
      } else {  // 2 m₀ + m₁ = 3 Δ₀/h₀
        matrix.at[i] = 2;
        (i == 0 ? matrix.above : matrix.below)[i] = 1;
        slope[i] = 3 / h[side] * (p[side + 1] - p[side]);
      }
      continue;
    }
    const std::size_t before = i == 0 ? spans - 1 : i - 1;
    matrix.below[i] = h[i];
    matrix.at[i] = 2 * (h[before] + h[i]);
    matrix.above[i] = h[before];
    slope[i] = 3 * (h[i] / h[before] * (p[before + 1] - p[before]) + h[before] / h[i] * (p[i + 1] - p[i]));
  }
  if (closed) {
    matrix.solve_periodic(slope);
    slope.push_back(slope.front());
  } else {
    matrix.solve(slope);
  }

  std::vector<Vec> points{p[0]};
  std::vector<double> knots{0, 0, 0, 0};
  double u = 0;
  for (std::size_t i = 0; i < spans; ++i) {
    points.push_back(p[i] + h[i] / 3 * slope[i]);
    points.push_back(p[i + 1] - h[i] / 3 * slope[i + 1]);
    points.push_back(p[i + 1]);
    u += h[i];
    knots.insert(knots.end(), 3, u);
  }
  knots.push_back(u);
  return drawn_spline(3, std::move(points), {}, std::move(knots));
}

struct Tags {
  std::vector<Vec> points, fit;
  std::vector<double> weights, knots;
  Vec start_tangent, end_tangent;
  long flags = 0, degree = 3;
};

Tags collected(const DxfRecord& record, ProgressScope& progress) {
  Tags t;
  Vec none;
  double number = 0;
  const auto listed = [&](const DxfTag& tag, int code, std::vector<Vec>& list) {
    if (tag.code == code) list.emplace_back();
    if (!take_point(tag, code, list.empty() ? none : list.back())) return false;
    if (list.empty()) refuse_dxf(tag.line, "a point has to begin with its x coordinate");
    return true;
  };
  for (const DxfTag& tag : record.tags) {
    progress.work();
    if (tag.code == 70) t.flags = dxf_integer(tag);
    if (tag.code == 71) t.degree = dxf_integer(tag);
    if (take_number(tag, 40, number)) t.knots.push_back(number);
    if (take_number(tag, 41, number)) t.weights.push_back(number);
    listed(tag, 10, t.points) || listed(tag, 11, t.fit) || take_point(tag, 12, t.start_tangent) ||
        take_point(tag, 13, t.end_tangent);
  }
  return t;
}

/// Knots that are equal but for the last digits written are made so: they would leave pieces without length.
void settle(std::vector<double>& knots) {
  if (knots.empty()) return;
  const double close = 1e-10 * (knots.back() - knots.front());
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (std::abs(knots[i] - knots[i - 1]) <= close) knots[i] = knots[i - 1];
}

}  // namespace

DxfShape dxf_spline(const DxfRecord& record, DxfTags& tags) {
  Tags t = collected(record, tags.progress());
  const bool closed = (t.flags & 3) != 0;
  DxfShape shape;
  try {
    if (t.points.empty()) {
      if (t.fit.size() < 2) refuse_dxf(record.line, "the SPLINE has neither control points nor two fit points");
      DrawnSpline spline = through(std::move(t.fit), closed, t.start_tangent, t.end_tangent);
      if (spline.points.empty())
        shape.without_length = 1;
      else
        shape.curves.emplace_back(std::move(spline));
      shape.note = "a SPLINE given by fit points alone: a cubic spline through them was taken";
      return shape;
    }
    if (t.degree < 1 || t.degree > 16) refuse_dxf(record.line, "the SPLINE's degree has to be between 1 and 16");
    const auto degree = static_cast<std::size_t>(t.degree);
    if (t.knots.size() != t.points.size() + degree + 1)
      refuse_dxf(record.line, "the SPLINE of degree " + std::to_string(degree) + " has " +
                                  std::to_string(t.points.size()) + " control points and " +
                                  std::to_string(t.knots.size()) + " knots; it takes points + degree + 1");
    settle(t.knots);
    const std::vector<Vec> polygon = degree == 1 ? t.points : std::vector<Vec>{};
    DrawnSpline spline = drawn_spline(degree, std::move(t.points), std::move(t.weights), std::move(t.knots));
    if (closed && norm(spline.to - spline.from) > 1e-6 * extent(spline))
      shape.note = "a SPLINE marked closed, but its curve ends elsewhere: taken as it stands";
    if (degree == 1) {  // passes all its control points
      for (std::size_t i = 1; i < polygon.size(); ++i) {
        if (polygon[i] == polygon[i - 1])
          ++shape.without_length;
        else
          shape.curves.emplace_back(DrawnLine{polygon[i - 1], polygon[i]});
      }
      return shape;
    }
    shape.curves.emplace_back(std::move(spline));
    return shape;
  } catch (const InvalidInput& e) {  // places inside a NURBS become lines
    std::vector<InputFault> faults;
    for (const InputFault& f : e.faults) {
      if (f.place.size() == 2 && f.place[0] == "contour") {
        faults.push_back(f);
        continue;
      }
      std::string where;
      for (std::size_t i = 1; i < f.place.size(); ++i) where += (i > 1 ? " " : "") + f.place[i];
      faults.push_back(dxf_fault(record.line, "SPLINE, " + where + ": " + f.message));
      if (faults.size() == 100) break;
    }
    throw InvalidInput(std::move(faults));
  }
}

}  // namespace bahnwerk
