// Converts a cut to segments: gaps are closed, every curve ends exactly where the next one begins.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/contour/dxf/cut/cut.hpp"

namespace bahnwerk {
namespace {

/// Returns whether the curve is long enough for an end to be moved by `gap` without changing its shape visibly.
bool movable(const Drawn& curve, double gap) {
  double size = 0;
  if (const auto* arc = std::get_if<DrawnArc>(&curve); arc != nullptr && arc->circular())
    size = norm(last_point(curve) - first_point(curve));
  else
    size = extent(curve);
  return gap < min_segment_length || gap <= 0.01 * size;
}

/// The similar arc between two points near its ends: its sweep stays. In the arc's plane, as complex numbers, centre −
/// from is multiplied by (end − begin)/(to − from).
void write_arc(ContourBuilder& builder, const DrawnArc& arc, Vec end) {
  const Vec begin = builder.position(), from = arc.at(arc.start), to = arc.at(arc.start + arc.sweep);
  const Vec e1 = arc.a / norm(arc.a), e2 = arc.b / norm(arc.b);
  Vec centre = arc.centre;
  const double chord = norm(to - from), moved = norm(begin - from) + norm(end - to);
  if (moved > 0 && chord >= 10 * moved) {
    const Vec old = to - from, now = end - begin, way = arc.centre - from;
    const double ox = dot(old, e1), oy = dot(old, e2), nx = dot(now, e1), ny = dot(now, e2);
    const double square = ox * ox + oy * oy;
    const double qx = (nx * ox + ny * oy) / square, qy = (ny * ox - nx * oy) / square;
    const double wx = dot(way, e1), wy = dot(way, e2);
    centre = begin + (qx * wx - qy * wy) * e1 + (qx * wy + qy * wx) * e2;
  } else if (chord < 10 * moved) {
    centre += begin - from;
  }
  const Vec normal = cross(e1, e2);
  const bool planar = normal.x == 0 && normal.y == 0;
  const bool counter_clockwise = (arc.sweep > 0) == (!planar || normal.z > 0);
  builder.arc(end, centre, counter_clockwise, planar ? Vec{0, 0, 1} : normal);
}

/// A span takes the builder some 10 µs: long splines are handed over in parts, each a spline of its own.
void write_spans(ContourBuilder& builder, const DrawnSpline& s, ProgressScope& progress) {
  constexpr std::size_t max_spans = 512, steps_per_span = 16;
  const std::size_t p = s.degree, n = s.points.size();
  const auto part = [](const auto& list, std::size_t first, std::size_t last) {
    const auto at = [&](std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
    return list.empty() ? list : std::decay_t<decltype(list)>(at(first), at(last));
  };
  // Between the knots k and end, k < end ≤ n, count the points k − p … end − 1 and the knots k − p … end + p.
  for (std::size_t k = p; k < n;) {
    std::size_t end = std::min(k + max_spans, n);
    while (end < n && s.knots[end] == s.knots[k]) ++end;  // a part needs a domain
    while (end < n && s.knots[end] == s.knots[end + 1]) ++end;
    if (s.knots[end] == s.knots[n]) end = n;
    builder.nurbs(static_cast<int>(p), part(s.points, k - p, end), part(s.weights, k - p, end),
                  part(s.knots, k - p, end + p + 1));
    progress.work(steps_per_span * (end - k));
    k = end;
  }
}

/// A displacement that is linear in the parameter takes the ends where they belong: a spline whose control points are
/// their Greville abscissae is the parameter itself.
void write_spline(ContourBuilder& builder, DrawnSpline spline, Vec end, ProgressScope& progress) {
  const Vec at_first = builder.position() - spline.from, at_last = end - spline.to;
  const std::size_t p = spline.degree, n = spline.points.size();
  const double begin = spline.knots[p], range = spline.knots[n] - begin;
  if (norm(at_first) > 0 || norm(at_last) > 0) {
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0;
      for (std::size_t k = 1; k <= p; ++k) sum += spline.knots[i + k] - begin;
      const double share = sum / (static_cast<double>(p) * range);
      spline.points[i] += (1 - share) * at_first + share * at_last;
    }
    // Clamped ends are exact, without the rounding above.
    if (spline.knots[1] == spline.knots[p]) spline.points.front() = builder.position();
    if (spline.knots[n] == spline.knots[n + p - 1]) spline.points.back() = end;
  }
  write_spans(builder, spline, progress);
}

}  // namespace

void write_cut(ContourBuilder& builder, const Cut& cut, GapReport& gaps, ProgressScope& progress) {
  const Vec start = builder.position();
  const std::size_t n = cut.curves.size();
  const auto bridge = [&](Vec to) {
    builder.line(to);
    ++gaps.bridged;
  };
  const auto noted = [&](double gap) {
    if (gap >= min_segment_length) gaps.worst = std::max(gaps.worst, gap);
    return gap;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Drawn& curve = cut.curves[i];
    builder.at_line(cut.lines[i]);
    progress.work();
    const Vec first = first_point(curve), last = last_point(curve);
    if (const double gap = noted(norm(first - builder.position())); !movable(curve, gap))
      bridge(first);
    else if (gap >= min_segment_length)
      ++gaps.moved;
    // If the next curve cannot be changed, this one is, and at the end of a closed cut it is moved to the start.
    Vec end = last;
    if (i + 1 < n) {
      const Vec next = first_point(cut.curves[i + 1]);
      const double gap = norm(next - last);
      if (!movable(cut.curves[i + 1], gap) && movable(curve, gap)) {
        end = next;
        ++gaps.moved;
        noted(gap);
      }
    } else if (cut.closed) {
      const double gap = norm(start - last);
      if (movable(curve, gap)) {
        end = start;
        if (noted(gap) >= min_segment_length) ++gaps.moved;
      }
    }
    if (std::holds_alternative<DrawnLine>(curve))
      builder.line(end);
    else if (const auto* arc = std::get_if<DrawnArc>(&curve))
      arc->circular() ? write_arc(builder, *arc, end) : write_spline(builder, drawn_spline(*arc), end, progress);
    else
      write_spline(builder, std::get<DrawnSpline>(curve), end, progress);
  }
  if (const double gap = norm(start - builder.position()); cut.closed && gap >= min_segment_length) {
    noted(gap);
    bridge(start);
  }
}

}  // namespace bahnwerk
