#include "core/motion/grid/section_repeats.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk {
namespace {

constexpr double tolerance = 1e-11;
// Allowed distance of a place from the law's place, relative to s: the verifier allows 32.
constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();

bool close(double a, double b, double scale) { return std::abs(a - b) <= tolerance * scale; }

using Rows = std::array<PathBatch::Row, max_axes>;

}  // namespace

SectionRepeats::SectionRepeats(const PathTask& task, const Sections& sections, ProgressScope& progress)
    : task_(task), sections_(sections), progress_(progress) {
  for (std::size_t k = 0; k < task.path.axes(); ++k)
    acceleration_ = std::hypot(acceleration_, task.machine.axes[k].acceleration);
}

std::size_t SectionRepeats::source(std::size_t i) {
  const std::size_t first = sections_.begin[i], last = sections_.begin[i + 1];
  const std::uint64_t shape = rough_shape(task_.path.tool(), first, last);
  for (const std::size_t earlier : index_.of(shape))
    if (same(earlier, i)) return earlier;
  index_.add(shape, i);
  return i;
}

bool SectionRepeats::same(std::size_t a, std::size_t b) const {
  const AxisPath& path = task_.path;
  const std::size_t first_a = sections_.begin[a], first_b = sections_.begin[b], n = sections_.begin[a + 1] - first_a;
  if (sections_.begin[b + 1] - first_b != n) return false;
  double length_a = 0, length_b = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Segment &s = path[first_a + i], &t = path[first_b + i];
    progress_.work();
    if (task_.feeds[first_a + i] != task_.feeds[first_b + i] || s.cusp_begin() != t.cusp_begin() ||
        s.cusp_end() != t.cusp_end() || path.linear(first_a + i) != path.linear(first_b + i))
      return false;
    length_a += s.travelled(s.curve().end()), length_b += t.travelled(t.curve().end());
  }
  const double ratio = length_b / length_a;
  if (!close(ratio, 1, 1)) return false;
  // No motion from rest to rest exceeds this value: caps above it do not matter.
  const double reach = path.cartesian() ? acceleration_ * length_a : unlimited;
  for (std::size_t i = 1; i < n; ++i) {
    const double cap = sections_.joint_cap[first_a + i], other = sections_.joint_cap[first_b + i];
    if (cap != other && !(std::min(cap, other) > reach) && !close(cap, other, cap)) return false;
  }
  for (std::size_t i = 0; i < n; ++i)
    if (!same_segment(first_a + i, first_b + i, ratio, length_a)) return false;
  return true;
}

bool SectionRepeats::same_segment(std::size_t a, std::size_t b, double ratio, double length) const {
  const AxisPath& path = task_.path;
  const Segment &s = path[a], &t = path[b];
  progress_.work(4);
  if (std::abs(t.travelled(t.curve().end()) - ratio * s.travelled(s.curve().end())) > rounding * t.s1()) return false;
  PathBatch p, q;
  p.count = q.count = path.linear(a) ? 2 : PathBatch::most;
  const auto lay = [](const Segment& on, PathBatch& batch) {
    const double u0 = on.curve().begin(), u1 = on.curve().end();
    const auto last = static_cast<double>(batch.count - 1);
    for (std::size_t i = 0; i < batch.count; ++i)
      batch.u.set(i, i + 1 == batch.count ? u1 : u0 + (u1 - u0) * (static_cast<double>(i) / last));
  };
  lay(s, p), lay(t, q);
  path.at_parameters(a, p), path.at_parameters(b, q);
  if (p.planar != q.planar) return false;
  const std::size_t axes = std::min<std::size_t>(path.axes(), p.planar ? 2 : max_axes);
  for (std::size_t i = 0; i < p.count; ++i)
    if (!close(p.s[i], q.s[i], length)) return false;
  const auto largest = [&](const Rows& rows, std::size_t k) {
    double most = 0;
    for (std::size_t i = 0; i < p.count; ++i) most = std::max(most, std::abs(rows[k][i]));
    return most;
  };
  AxisArray d1{}, d2{}, d3{};  // largest derivatives of each axis
  for (std::size_t k = 0; k < axes; ++k) d1[k] = largest(p.d1, k), d2[k] = largest(p.d2, k), d3[k] = largest(p.d3, k);
  if (path.cartesian())  // all axes of a Cartesian machine have one unit
    for (AxisArray* row : {&d1, &d2, &d3}) row->fill(*std::max_element(row->begin(), row->end()));
  const auto same = [&](const Rows& left, const Rows& right, std::size_t k, double scale) {
    for (std::size_t i = 0; i < p.count; ++i)
      if (!close(left[k][i], right[k][i], scale)) return false;
    return true;
  };
  for (std::size_t k = 0; k < axes; ++k) {
    const double bend = d2[k] + d1[k] / length;
    if (!same(p.d1, q.d1, k, d1[k]) || !same(p.d2, q.d2, k, bend) || !same(p.d3, q.d3, k, d3[k] + bend / length))
      return false;
  }
  return true;
}

}  // namespace bahnwerk
