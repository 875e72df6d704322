#include "core/verify/geometry/tube_block.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/geometry/frechet.hpp"

namespace bahnwerk::verify {

namespace {

constexpr double finest = 1e-6;        // mm
constexpr double leaving = 2;          // tolerances: so far from a point the contour has left it
constexpr double slack_share = 0.004;  // of the tolerance: what polygons may differ from both curves
constexpr double enough = 0.99;        // of the tolerance: no need to know better
constexpr std::size_t max_cells_per_edge = 64, min_cells = 50'000'000;
constexpr std::size_t max_points = 20'000'000;
constexpr std::size_t limb_units = 16, cell_units = 8;  // of a pulse's work

}  // namespace

Worst TubeBlock::measure(const Stretch& given, const Stretch& path) {
  given_ = given;
  path_ = path;
  cut(given, limbs_);
  cut(path, links_);
  match();
  Worst worst = bound();
  if (worst.value <= tolerance_ || std::isnan(worst.value)) return worst;
  // The matching may be to blame. Polygons take as much memory as its pieces, which are done with.
  limbs_ = std::vector<CurvePiece>();
  links_ = std::vector<CurvePiece>();
  cells_ = std::vector<Cell>();
  const double bulge = 0.5 * slack_share * tolerance_;
  if (!polygon(given_, bulge, given_points_) || !polygon(path_, bulge, path_points_)) return worst;
  for (const double share : {enough, 1.0})
    if (traversable((share - slack_share) * tolerance_)) return {share * tolerance_, worst.at};
  return worst;
}

void TubeBlock::cut(const Stretch& stretch, std::vector<CurvePiece>& curve_pieces) {
  curve_pieces.clear();
  for (std::size_t i = stretch.first; i < stretch.last; ++i) {
    pulse_.work(limb_units);
    add_curve_pieces((*stretch.path)[i], i, curve_pieces);
  }
}

/// Lays the cells: every curve_piece of the path against the curve_pieces of the contour that belong to it.
void TubeBlock::match() {
  cells_.clear();
  std::size_t curve_piece = 0;
  double at = limbs_[0].u0;
  Vec p = limbs_[0].p0;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    pulse_.work(limb_units);
    std::size_t to = limbs_.size() - 1;
    double place = limbs_.back().u1;
    if (i + 1 < links_.size()) follow(links_[i], curve_piece, at, to, place);
    lay(links_[i], curve_piece, at, p, to, place);
    curve_piece = to;
    at = place;
    p = (*given_.path)[limbs_[curve_piece].segment].curve().at(at).value;
  }
}

/// Where on the contour, from (curve_piece, at) on, the end of a path curve_piece belongs: the contour is followed
/// until it comes within the tolerance of that end; the nearest point before it leaves again for good is taken.
void TubeBlock::follow(const CurvePiece& link, std::size_t curve_piece, double at, std::size_t& to,
                       double& place) const {
  const double near = tolerance_ * (1 + 1e-9) + 1e-9, most = 20 * link.length + 200 * near;
  double best = HUGE_VAL, walked = 0;
  bool entered = false;
  to = curve_piece;
  place = at;
  for (std::size_t k = curve_piece; k < limbs_.size() && walked <= most; ++k) {
    const CurvePiece& l = limbs_[k];
    const double from = k == curve_piece ? at : l.u0;
    pulse_.work(1);
    const Nearest n = nearest((*given_.path)[l.segment].curve(), from, l.u1, link.p1);
    if (n.distance < best) best = n.distance, to = k, place = n.u;
    entered = entered || n.distance <= near;
    if (entered && norm(l.p1 - link.p1) > leaving * near) return;
    if (k > curve_piece) walked += l.length;
  }
}

/// Cells of one path curve_piece against the contour from (curve_piece, at) = p to (to, place).
void TubeBlock::lay(const CurvePiece& link, std::size_t curve_piece, double at, Vec p, std::size_t to, double place) {
  const Curve& curve = (*path_.path)[link.segment].curve();
  Cell c;
  c.path = link.segment;
  c.pieces.a0 = link.u0;
  c.pieces.d0 = norm(link.p0 - p);
  for (std::size_t k = curve_piece; k <= to; ++k) {
    const CurvePiece& l = limbs_[k];
    c.given = l.segment;
    c.pieces.b0 = k == curve_piece ? at : l.u0;
    if (k < to) {
      const Nearest n = nearest(curve, c.pieces.a0, link.u1, l.p1);
      c.pieces.b1 = l.u1;
      c.pieces.a1 = n.u;
      c.pieces.d1 = n.distance;
    } else {
      c.pieces.b1 = place;
      c.pieces.a1 = link.u1;
      c.pieces.d1 = norm(link.p1 - (*given_.path)[l.segment].curve().at(place).value);
    }
    cells_.push_back(c);
    c.pieces.a0 = c.pieces.a1;
    c.pieces.d0 = c.pieces.d1;
  }
}

Worst TubeBlock::bound() {
  Worst worst;
  const double slack = std::min(finest, 1e-3 * tolerance_);
  double found = 0;
  for (const Cell& c : cells_)
    if (c.pieces.ends() <= tolerance_) found = std::max(found, c.pieces.ends());
  for (const Cell& c : cells_) {
    pulse_.work(cell_units);
    const Segment& segment = (*path_.path)[c.path];
    const MatchedDistance distance(segment.curve(), (*given_.path)[c.given].curve(), &pulse_);
    const double b = distance.bound(c.pieces, tolerance_, slack, found);
    if (std::isnan(b) || b > worst.value) worst.raise(b, segment.arc_length(c.pieces.a1));
  }
  return worst;
}

bool TubeBlock::traversable(double radius) {
  const std::size_t most = std::max(min_cells, max_cells_per_edge * (given_points_.size() + path_points_.size()));
  return traverse_within(path_points_, given_points_, radius, most, pulse_) == Traversal::possible;
}

/// Points of a stretch between which it bulges by no more than `bulge` from the chord. False: too many.
bool TubeBlock::polygon(const Stretch& stretch, double bulge, std::vector<Vec>& points) {
  points.clear();
  for (std::size_t i = stretch.first; i < stretch.last; ++i) {
    const Curve& curve = (*stretch.path)[i].curve();
    if (points.empty()) points.push_back(curve.at(curve.begin()).value);
    const BendBound bend(curve);
    const auto add = [&](const auto& self, double u0, double u1, int depth) -> void {
      const double w = u1 - u0;
      pulse_.work(1);
      if (depth > 0 && !(bend.at(u0, u1) * w * w / 8 <= bulge) && points.size() < max_points) {
        self(self, u0, 0.5 * (u0 + u1), depth - 1);
        self(self, 0.5 * (u0 + u1), u1, depth - 1);
        return;
      }
      points.push_back(curve.at(u1).value);
    };
    constexpr int max_halvings = 40;
    add(add, curve.begin(), curve.end(), max_halvings);
    if (points.size() >= max_points) return false;
  }
  return true;
}

}  // namespace bahnwerk::verify
