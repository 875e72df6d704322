#include "core/contour/blend/elements.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk::blending {

Jet Element::at(double along) const {
  if (straight) return {from + along * tangent, tangent, {}, {}};
  return segment->at(segment->s0() + along);
}

std::shared_ptr<const Curve> Element::part(double a, double b) const {
  const bool whole = a <= 0 && b >= length;
  // The element does not own its curve, and the given contour may be destroyed, so a curve is copied by its type.
  if (straight) return std::make_shared<Line>(from + a * tangent, from + b * tangent);
  const Curve& curve = segment->curve();
  const double u0 = a <= 0 ? curve.begin() : segment->parameter(segment->s0() + a);
  const double u1 = b >= length ? curve.end() : segment->parameter(segment->s0() + b);
  if (curve.kind() == CurveKind::arc) {
    const auto& arc = static_cast<const Arc&>(curve);
    if (whole) return std::make_shared<Arc>(arc);
    const double turn = u0 * arc.sweep(), c = std::cos(turn), s = std::sin(turn);
    return std::make_shared<Arc>(arc.centre() + (u0 * arc.rise()) * arc.normal(), c * arc.e1() + s * arc.e2(),
                                 c * arc.e2() - s * arc.e1(), arc.radius(), (u1 - u0) * arc.sweep(),
                                 (u1 - u0) * arc.rise());
  }
  const auto& rational = static_cast<const Rational&>(curve);
  if (whole) return std::make_shared<Rational>(rational);
  // A vanishing tangent at an end that is included stays the pivot, exactly.
  if (rational.vanishing_begin() > 0 && a <= 0)
    return std::make_shared<Rational>(rational.restricted(u0, u1, u0, rational.vanishing_begin()));
  if (rational.vanishing_end() > 0 && b >= length)
    return std::make_shared<Rational>(rational.restricted(u0, u1, u1, rational.vanishing_end()));
  return std::make_shared<Rational>(rational.restricted(u0, u1, 0.5 * (u0 + u1)));
}

std::size_t ElementRun::find(double t, std::size_t hint) const {
  const std::size_t n = elements.size();
  for (std::size_t i = hint; i < std::min(n, hint + 2); ++i)
    if ((i == 0 || t >= elements[i].begin) && (i + 1 == n || t < elements[i + 1].begin)) return i;
  const auto after = std::upper_bound(elements.begin(), elements.end(), t,
                                      [](double value, const Element& e) { return value < e.begin; });
  return after == elements.begin() ? 0 : static_cast<std::size_t>(after - elements.begin()) - 1;
}

std::size_t ElementRun::near(double t, std::size_t from) const {
  constexpr int few = 16;
  const std::size_t n = elements.size();
  std::size_t i = std::min(from, n - 1);
  for (int step = 0; step < few; ++step) {
    if (i + 1 < n && elements[i + 1].begin <= t)
      ++i;
    else if (i > 0 && t < elements[i].begin)
      --i;
    else
      return i;
  }
  return find(t, n);
}

namespace {

Vec start_of(const Segment& s) { return s.curve().at(s.curve().begin()).value; }
Vec end_of(const Segment& s) { return s.curve().at(s.curve().end()).value; }

Element whole(const Path& path, std::size_t i, std::size_t block) {
  const Segment& s = path[i];
  Element e;
  e.first = i;
  e.segment = &s;
  e.straight = s.straight();
  if (e.straight) {
    e.from = start_of(s);
    e.tangent = s.at_parameter(s.curve().begin()).d1;
  }
  e.length = s.length();
  e.source = s.source();
  e.block = block;
  return e;
}

/// Returns the indices of the vertices that remain of a chain: its ends, and those at least `tiny` from the one before.
/// Every other vertex is closer than that to one that remains.
std::vector<std::size_t> remaining(const std::vector<Vec>& vertices, double tiny) {
  constexpr double no_length = 1e-12;  // mm
  std::vector<std::size_t> list{0};
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const auto near = [&](std::size_t other) { return norm(vertices[i] - vertices[other]) < tiny; };
    const bool last = i + 1 == vertices.size();
    if (near(list.back()) && !last) continue;
    if (last && list.size() > 1 && !near(list[list.size() - 2])) {  // the end is fixed: the vertex before it may go
      std::size_t k = i;
      while (k >= list.back() && near(k)) --k;
      if (k < list.back()) list.pop_back();
    }
    if (norm(vertices[i] - vertices[list.back()]) >= no_length) list.push_back(i);
  }
  return list;
}

/// Appends lines [first, last) of one block with their vertices thinned. Both directions of a chain keep the same
/// vertices.
void append_lines(const Path& path, std::size_t first, std::size_t last, const std::vector<std::size_t>& blocks,
                  double tiny, std::vector<Element>& out) {
  const auto short_line = [&](std::size_t i) { return path[i].length() < tiny; };
  std::size_t i = first;
  while (i < last && !short_line(i)) ++i;
  if (i == last) {
    for (i = first; i < last; ++i) out.push_back(whole(path, i, blocks[i]));
    return;
  }
  std::vector<Vec> vertices{start_of(path[first])};
  for (i = first; i < last; ++i) vertices.push_back(end_of(path[i]));
  const bool from_end =
      begins_at_end(path[first].s0(), path[last - 1].s1(), [&](double s) { return path.at(s).value; });
  if (from_end) std::reverse(vertices.begin(), vertices.end());
  std::vector<std::size_t> list = remaining(vertices, tiny);
  if (from_end) {
    std::reverse(vertices.begin(), vertices.end());
    std::reverse(list.begin(), list.end());
    for (std::size_t& vertex : list) vertex = last - first - vertex;
  }
  for (std::size_t k = 1; k < list.size(); ++k) {
    const std::size_t begin = list[k - 1], end = list[k];
    if (end == begin + 1) {
      out.push_back(whole(path, first + begin, blocks[first]));
      continue;
    }
    Element e;
    e.from = vertices[begin];
    e.length = norm(vertices[end] - e.from);
    e.tangent = (vertices[end] - e.from) / e.length;
    e.source = path[first + begin].source();
    e.block = blocks[first];
    e.first = first + begin;
    out.push_back(e);
  }
}

}  // namespace

bool begins_at_end(double a, double b, const std::function<Vec(double)>& point) {
  constexpr double clear = 1e-7;
  const Vec begin = point(a), end = point(b);
  for (const double part : {0.5, 0.25, 0.125, 0.375, 0.0625, 0.1875, 0.3125, 0.4375}) {
    const double first = norm(point(a + part * (b - a)) - begin), last = norm(point(b - part * (b - a)) - end);
    if (std::abs(first - last) > clear * std::max(first, last)) return first > last;
  }
  return false;
}

std::vector<ElementRun> element_runs(const Path& path, std::size_t first, std::size_t last,
                                     const std::vector<std::size_t>& blocks, const ElementOptions& options,
                                     ProgressScope& progress) {
  std::vector<Element> elements;
  for (std::size_t i = first; i < last;) {
    progress.work();
    if (!path[i].straight()) {
      elements.push_back(whole(path, i, blocks[i]));
      ++i;
      continue;
    }
    std::size_t j = i;
    while (j < last && path[j].straight() && blocks[j] == blocks[i]) ++j;
    const std::size_t before = elements.size();
    append_lines(path, i, j, blocks, options.tiny, elements);
    // The block is a loop that small; it must not be lost.
    if (elements.size() == before)
      for (std::size_t k = i; k < j; ++k) elements.push_back(whole(path, k, blocks[k]));
    i = j;
  }
  std::vector<ElementRun> list;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    progress.work();
    Element& e = elements[i];
    bool cut = i == 0;
    if (i > 0) {
      const Element& before = elements[i - 1];
      cut = (before.segment && before.segment->cusp_end()) || (e.segment && e.segment->cusp_begin()) ||
            angle_between(before.at(before.length).d1, e.at(0).d1) > options.reversal;
    }
    if (cut) list.emplace_back();
    e.begin = list.back().length();
    list.back().elements.push_back(e);
  }
  return list;
}

}  // namespace bahnwerk::blending
