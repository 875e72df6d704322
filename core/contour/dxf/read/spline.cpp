// SPLINE: control points, weights and knots as they stand; with fit points alone the cubic spline through them.
#include <algorithm>
#include <cmath>

#include "core/contour/dxf/read/entity.hpp"
#include "core/numeric/linear/symmetric_band.hpp"

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
  // Around a closed spline, points 0, n − 1, 1, n − 2 … follow each other: neighbours stay within two places.
  const auto place = [&](std::size_t i) { return !closed ? i : 2 * i < n ? 2 * i : 2 * (n - i) - 1; };
  SymmetricBand<2> matrix(n);
  std::vector<Vec> right(n);
  for (std::size_t i = 0; i < spans; ++i) {  // a span's part of the gradient of ½ ∫ |f″|²
    const std::size_t a = place(i), b = place((i + 1) % n);
    const double w = 1 / h[i];
    const Vec rise = 3 * w * w * (p[i + 1] - p[i]);
    matrix.at(a, a) += 2 * w, matrix.at(b, b) += 2 * w, matrix.at(std::max(a, b), std::min(a, b)) += w;
    right[a] += rise, right[b] += rise;
  }
  for (const bool end : {false, true}) {
    const Vec tangent = end ? end_tangent : start_tangent;
    if (closed || !(norm(tangent) > 0)) continue;
    const std::size_t given = end ? n - 1 : 0, next = end ? n - 2 : 1;
    double& coupling = matrix.at(end ? given : next, end ? next : given);
    right[given] = tangent / norm(tangent);
    right[next] += -coupling * right[given];
    matrix.at(given, given) = 1, coupling = 0;
  }
  matrix.factor();
  std::vector<Vec> slope(n);
  std::vector<double> x(n);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < n; ++i) x[i] = right[i][axis];
    matrix.solve(x);
    for (std::size_t i = 0; i < n; ++i) slope[i][axis] = x[place(i)];
  }
  if (closed) slope.push_back(slope.front());

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
