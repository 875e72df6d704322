#include "core/verify/geometry/tube_block.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/geometry/frechet.hpp"

namespace bahnwerk::verify {

namespace {

constexpr double finest = 1e-6;        // mm
constexpr double leaving = 2;          // tolerances: so far from a point the contour has left it
constexpr double slack_share = 0.004;  // part of the tolerance by which polygons may differ from both curves together
constexpr double enough = 0.99;        // part of the tolerance that is tried before the whole one
constexpr std::size_t max_cells_per_edge = 64, min_cells = 50'000'000;
constexpr std::size_t max_points = 20'000'000;
constexpr std::size_t narrow = 8,
                      wider = 8;  // pieces around a place in the first window, and the factor of the next ones
constexpr std::size_t limb_units = 16, cell_units = 8;  // units of work for progress

}  // namespace

Worst TubeBlock::measure(const PathRange& given, const PathRange& path) {
  given_ = given;
  path_ = path;
  cut(given, limbs_);
  cut(path, links_);
  match();
  if (strayed_.empty() || std::isnan(far_.value)) return strayed_.empty() ? near_ : far_;
  // The matching may be to blame.
  for (std::size_t margin = narrow;; margin *= wider) {
    double most = near_.value;
    bool all = true;
    for (const Window& window : windows(margin)) {
      const double radius = decided(window);
      all = all && radius <= tolerance_;
      if (!all) break;
      most = std::max(most, radius);
    }
    if (all) return {most, most > near_.value ? far_.at : near_.at};
    if (margin > links_.size()) return far_;
  }
}

void TubeBlock::cut(const PathRange& stretch, std::vector<CurvePiece>& curve_pieces) {
  curve_pieces.clear();
  for (std::size_t i = stretch.first; i < stretch.last; ++i) {
    progress_.work(limb_units);
    add_curve_pieces((*stretch.path)[i], i, curve_pieces);
  }
}

/// Every piece of the path against the pieces of the contour that belong to it.
void TubeBlock::match() {
  ends_.clear();
  strayed_.clear();
  near_ = far_ = {};
  Match at{0, limbs_[0].u0, norm(links_[0].p0 - limbs_[0].p0)};
  double found = 0;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    progress_.work(limb_units);
    const CurvePiece& link = links_[i];
    const Match to = i + 1 < links_.size()
                         ? follow(link, at)
                         : Match{limbs_.size() - 1, limbs_.back().u1, norm(link.p1 - limbs_.back().p1)};
    lay(link, at, to);
    const Worst worst = bound(found);
    if (worst.value <= tolerance_) {
      if (worst.value > near_.value) near_ = worst;
    } else {
      strayed_.push_back(i);
      if (std::isnan(worst.value) || worst.value > far_.value) far_.raise(worst.value, worst.at);
    }
    ends_.push_back(to);
    at = to;
  }
}

/// Returns the place of the contour, from `from` on, that is matched to the end of a piece of the path: the contour is
/// followed until it is within the tolerance of that end; the nearest point before it finally leaves the tolerance is
/// taken.
TubeBlock::Match TubeBlock::follow(const CurvePiece& link, const Match& from) const {
  const double near = tolerance_ * (1 + 1e-9) + 1e-9, most = 20 * link.length + 200 * near;
  double walked = 0;
  bool entered = false;
  Match best{from.limb, from.u, HUGE_VAL};
  for (std::size_t k = from.limb; k < limbs_.size() && walked <= most; ++k) {
    const CurvePiece& l = limbs_[k];
    progress_.work(1);
    const Nearest n = nearest((*given_.path)[l.segment].curve(), k == from.limb ? from.u : l.u0, l.u1, link.p1);
    if (n.distance < best.distance) best = {k, n.u, n.distance};
    entered = entered || n.distance <= near;
    if (entered && norm(l.p1 - link.p1) > leaving * near) break;
    if (k > from.limb) walked += l.length;
  }
  return best;
}

/// Cells of one piece of the path against the contour between two places.
void TubeBlock::lay(const CurvePiece& link, const Match& from, const Match& to) {
  const Curve& curve = (*path_.path)[link.segment].curve();
  cells_.clear();
  Cell c;
  c.path = link.segment;
  c.pieces.a0 = link.u0;
  c.pieces.d0 = from.distance;
  for (std::size_t k = from.limb; k <= to.limb; ++k) {
    const CurvePiece& l = limbs_[k];
    c.given = l.segment;
    c.pieces.b0 = k == from.limb ? from.u : l.u0;
    if (k < to.limb) {
      const Nearest n = nearest(curve, c.pieces.a0, link.u1, l.p1);
      c.pieces.b1 = l.u1;
      c.pieces.a1 = n.u;
      c.pieces.d1 = n.distance;
    } else {
      c.pieces.b1 = to.u;
      c.pieces.a1 = link.u1;
      c.pieces.d1 = to.distance;
    }
    cells_.push_back(c);
    c.pieces.a0 = c.pieces.a1;
    c.pieces.d0 = c.pieces.d1;
  }
}

/// Returns the bound over the current cells; `found` is the largest distance within the tolerance so far.
Worst TubeBlock::bound(double& found) {
  Worst worst;
  const double slack = std::min(finest, 1e-3 * tolerance_);
  for (const Cell& c : cells_)
    if (c.pieces.ends() <= tolerance_) found = std::max(found, c.pieces.ends());
  for (const Cell& c : cells_) {
    progress_.work(cell_units);
    const Segment& segment = (*path_.path)[c.path];
    const MatchedDistance distance(segment.curve(), (*given_.path)[c.given].curve(), &progress_);
    const double b = distance.bound(c.pieces, tolerance_, slack, found);
    if (std::isnan(b) || b > worst.value) worst.raise(b, segment.arc_length(c.pieces.a1));
  }
  return worst;
}

/// Returns whether both sides of the beginning of a piece may be treated separately, because it is matched well.
bool TubeBlock::separates(std::size_t link) const {
  return link == 0 || link >= links_.size() || ends_[link - 1].distance <= (enough - slack_share) * tolerance_;
}

/// The surroundings of all that strayed, `margin` links on either side, none of which overlaps another.
std::vector<TubeBlock::Window> TubeBlock::windows(std::size_t margin) const {
  std::vector<Window> list;
  for (const std::size_t link : strayed_) {
    Window window{link - std::min(link, margin), std::min(links_.size(), link + margin + 1)};
    while (!separates(window.first)) --window.first;
    while (!separates(window.last)) ++window.last;
    if (list.empty() || window.first >= list.back().last)
      list.push_back(window);
    else
      list.back().last = std::max(list.back().last, window.last);
  }
  return list;
}

/// A radius within which path and contour can be traversed along a window; infinite: none that is within the tolerance.
double TubeBlock::decided(const Window& window) {
  const CurvePiece &first = links_[window.first], &last = links_[window.last - 1];
  const Match from = window.first > 0 ? ends_[window.first - 1] : Match{0, limbs_[0].u0, 0};
  const Match& to = ends_[window.last - 1];
  if (!polygon(*given_.path, limbs_[from.limb], from.u, limbs_[to.limb], to.u, given_points_) ||
      !polygon(*path_.path, first, first.u0, last, last.u1, path_points_))
    return HUGE_VAL;
  const std::size_t most = std::max(min_cells, max_cells_per_edge * (given_points_.size() + path_points_.size()));
  for (const double share : {enough, 1.0})
    if (traverse_within(path_points_, given_points_, (share - slack_share) * tolerance_, most, progress_) ==
        Traversal::possible)
      return share * tolerance_;
  return HUGE_VAL;
}

/// Points between which a path bulges by no more than half of the slack from the chord, from a parameter on the piece
/// `first` to one on the piece `last`. False: too many.
bool TubeBlock::polygon(const Path& path, const CurvePiece& first, double begin, const CurvePiece& last, double end,
                        std::vector<Vec>& points) {
  const double bulge = 0.5 * slack_share * tolerance_;
  points.assign(1, path[first.segment].curve().at(begin).value);
  for (std::size_t i = first.segment; i <= last.segment; ++i) {
    const Curve& curve = path[i].curve();
    const SecondDerivativeBound bend(curve);
    const auto add = [&](const auto& self, double u0, double u1, int depth) -> void {
      const double w = u1 - u0;
      progress_.work(1);
      if (depth > 0 && !(bend.at(u0, u1) * w * w / 8 <= bulge) && points.size() < max_points) {
        self(self, u0, 0.5 * (u0 + u1), depth - 1);
        self(self, 0.5 * (u0 + u1), u1, depth - 1);
        return;
      }
      points.push_back(curve.at(u1).value);
    };
    constexpr int max_halvings = 40;
    add(add, i == first.segment ? begin : curve.begin(), i == last.segment ? end : curve.end(), max_halvings);
    if (points.size() >= max_points) return false;
  }
  return true;
}

}  // namespace bahnwerk::verify
