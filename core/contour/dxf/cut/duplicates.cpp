// Entities that are drawn twice: files from shops hold them by the hundred, and each would be cut twice.
#include <algorithm>
#include <cmath>

#include "core/base/progress_scope.hpp"
#include "core/contour/dxf/cut/cut.hpp"
#include "core/contour/dxf/cut/point_grid.hpp"
namespace bahnwerk {
namespace {

bool near(Vec a, Vec b, double tolerance) { return norm(a - b) <= tolerance; }

bool same_curve(const Drawn& a, const Drawn& b, bool turned, double tolerance) {
  if (a.index() != b.index()) return false;
  if (!near(first_point(a), turned ? last_point(b) : first_point(b), tolerance)) return false;
  if (!near(last_point(a), turned ? first_point(b) : last_point(b), tolerance)) return false;
  if (std::holds_alternative<DrawnLine>(a)) return true;
  // Three inner points settle arcs and conics; of splines the control points have to agree, too.
  for (const double share : {0.25, 0.5, 0.75})
    if (!near(point_at(a, share), point_at(b, turned ? 1 - share : share), tolerance)) return false;
  const auto *s = std::get_if<DrawnSpline>(&a), *t = std::get_if<DrawnSpline>(&b);
  if (s == nullptr) return true;
  if (s->degree != t->degree || s->points.size() != t->points.size()) return false;
  for (std::size_t i = 0, n = s->points.size(); i < n; ++i)
    if (!near(s->points[i], t->points[turned ? n - 1 - i : i], tolerance)) return false;
  return true;
}

bool same_strand(const DxfStrand& a, const DxfStrand& b, bool turned, double tolerance, ProgressScope& progress) {
  const std::size_t n = a.curves.size();
  if (b.curves.size() != n) return false;
  for (std::size_t i = 0; i < n; ++i) {
    progress.work();
    if (!same_curve(a.curves[i], b.curves[turned ? n - 1 - i : i], turned, tolerance)) return false;
  }
  return true;
}

}  // namespace

std::size_t drop_duplicates(std::vector<DxfStrand>& strands, double tolerance, Progress progress) {
  // The key of a strand does not depend on its direction: the middle between its ends, and its length.
  PointGrid grid(4 * tolerance, strands.size());
  std::vector<DxfStrand> kept;
  kept.reserve(strands.size());
  std::size_t dropped = 0;
  ProgressScope reading(progress.part(0, 0), "reading");
  for (DxfStrand& strand : strands) {
    double length = 0;
    for (const Drawn& curve : strand.curves) length += extent(curve);
    reading.work(1 + strand.curves.size());
    const Vec middle = 0.5 * (first_point(strand.curves.front()) + last_point(strand.curves.back()));
    const Vec key{middle.x, middle.y, length};
    bool again = false;
    grid.near(key, [&](std::size_t i, double) {
      again = same_strand(kept[i], strand, false, tolerance, reading) ||
              same_strand(kept[i], strand, true, tolerance, reading);
      return !again;
    });
    // An entity hardly longer than the tolerance would equal its neighbours.
    if (again && length > 10 * tolerance) {
      ++dropped;
      continue;
    }
    grid.add(key);
    kept.push_back(std::move(strand));
  }
  strands = std::move(kept);
  return dropped;
}

}  // namespace bahnwerk
