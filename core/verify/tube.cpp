#include "core/verify/tube.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/verify/limb.hpp"
#include "core/verify/tube_bound.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {

namespace {

using verify::Limb;
using verify::Nearest;
using verify::nearest;

constexpr int cell_depth = 48;
constexpr double finest = 1e-6;   // mm
constexpr double reach_back = 8;  // tolerances along the other curve
constexpr double longest = 40;    // tolerances: in more a missing way there and back would not show
constexpr double close = 0.99;    // of the tolerance: no need to know better
constexpr std::size_t breath = 2048;

/// Matched pieces: [b0, b1] of a path segment, [a0, a1] of a contour segment, with the distances at both ends.
struct Cell {
  std::size_t path = 0, given = 0;
  double b0 = 0, b1 = 0, a0 = 0, a1 = 0, d0 = 0, d1 = 0;
  std::size_t link = 0, limb = 0;  ///< of path and contour
  double ends() const { return std::isnan(d0) || d0 > d1 ? d0 : d1; }
};

class Tube {
 public:
  Tube(const Contour& given, const Contour& path, double tolerance, Progress& progress, double from, double to)
      : given_(given.path), path_(path.path), tolerance_(tolerance), progress_(progress), from_(from), to_(to) {}

  verify::Worst run() {
    if (given_.empty() || path_.empty()) return {HUGE_VAL, 0};
    cut(given_, limbs_);
    cut(path_, links_);
    verify::Worst best{HUGE_VAL, 0};
    // Any matching proves what it finds; where a contour is all coils within its tolerance another one may prove more.
    for (const Choice& choice : choices) {
      choice_ = choice;
      match();
      const verify::Worst worst = measure();
      if (!(worst.value >= best.value)) best = worst;
      if (best.value <= tolerance_ || std::isnan(best.value)) break;
    }
    return best;
  }

 private:
  /// How `follow` chooses among places that are near enough.
  struct Choice {
    double leaving;  ///< tolerances: so far from a point the contour has left it
    double haste;    ///< price of getting ahead of the path, mm per mm
  };
  static constexpr Choice choices[] = {{2, 0}, {2, 0.2}, {1, 0}, {4, 0.2}, {4, 1}};

  verify::Worst measure() {
    verify::Worst worst;
    const double slack = std::min(finest, 1e-3 * tolerance_);
    double found = 0;
    for (const Cell& c : cells_)
      if (c.ends() <= tolerance_) found = std::max(found, c.ends());
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (i % breath == 0) tell(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(cells_.size()));
      const Cell& c = cells_[i];
      const verify::BendBound along(path_[c.path].curve()), beside(given_[c.given].curve());
      const double before = worst.value;
      double bound = refine(c, along, beside, slack, found, cell_depth);
      // The matching may be to blame: each side for itself against what lies near on the other.
      if (bound > tolerance_ && short_enough(c))
        bound = std::max(stray(path_, links_[c.link], c.b0, c.b1, given_, limbs_, c.limb, slack, found),
                         stray(given_, limbs_[c.limb], c.a0, c.a1, path_, links_, c.link, slack, found));
      if (std::isnan(bound) || bound > before) worst.raise(bound, path_[c.path].arc_length(c.b1));
    }
    return worst;
  }

  void tell(double share) { progress_.report("verify", from_ + share * (to_ - from_)); }

  void cut(const Path& path, std::vector<Limb>& limbs) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (i % breath == 0) tell(0);
      verify::add_limbs(path[i], i, limbs);
    }
  }

  /// Lays the cells: every limb of the path against the limbs of the contour that belong to it.
  void match() {
    cells_.clear();
    std::size_t limb = 0;
    double at = limbs_[0].u0;
    Vec p = limbs_[0].p0;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (i % breath == 0) tell(0.5 * static_cast<double>(i) / static_cast<double>(links_.size()));
      std::size_t to = limbs_.size() - 1;
      double place = limbs_.back().u1;
      if (i + 1 < links_.size()) follow(links_[i], limb, at, to, place);
      lay(i, limb, at, p, to, place);
      limb = to;
      at = place;
      p = given_[limbs_[limb].segment].curve().at(at).value;
    }
  }

  /// Where on the contour, from (limb, at) on, the end of a path limb belongs: the contour is followed until it comes
  /// within the tolerance of that end; the nearest point before it leaves again for good is taken.
  void follow(const Limb& link, std::size_t limb, double at, std::size_t& to, double& place) const {
    const double near = tolerance_ * (1 + 1e-9) + 1e-9, most = 20 * link.length + 200 * near;
    double best = HUGE_VAL, walked = 0;
    bool entered = false;
    to = limb;
    place = at;
    for (std::size_t k = limb; k < limbs_.size() && walked <= most; ++k) {
      const Limb& l = limbs_[k];
      const double from = k == limb ? at : l.u0;
      const Nearest n = nearest(given_[l.segment].curve(), from, l.u1, link.p1);
      const double price = n.distance + choice_.haste * std::max(0.0, walked - link.length);
      if (price < best) best = price, to = k, place = n.u;
      entered = entered || n.distance <= near;
      if (entered && norm(l.p1 - link.p1) > choice_.leaving * near) return;
      if (k > limb) walked += l.length;
    }
  }

  /// Cells of one path limb against the contour from (limb, at) = p to (to, place).
  void lay(std::size_t index, std::size_t limb, double at, Vec p, std::size_t to, double place) {
    const Limb& link = links_[index];
    const Curve& curve = path_[link.segment].curve();
    Cell c;
    c.path = link.segment;
    c.link = index;
    c.b0 = link.u0;
    c.d0 = norm(link.p0 - p);
    for (std::size_t k = limb; k <= to; ++k) {
      const Limb& l = limbs_[k];
      c.given = l.segment;
      c.limb = k;
      c.a0 = k == limb ? at : l.u0;
      if (k < to) {
        const Nearest n = nearest(curve, c.b0, link.u1, l.p1);
        c.a1 = l.u1;
        c.b1 = n.u;
        c.d1 = n.distance;
      } else {
        c.a1 = place;
        c.b1 = link.u1;
        c.d1 = norm(curve.at(c.b1).value - given_[l.segment].curve().at(place).value);
      }
      cells_.push_back(c);
      c.b0 = c.b1;
      c.d0 = c.d1;
    }
  }

  /// Upper bound over a cell, refined until it is no more than `slack` above the largest distance found.
  double refine(const Cell& c, const verify::BendBound& along, const verify::BendBound& beside, double slack,
                double& found, int depth) {
    const double wb = c.b1 - c.b0, wa = c.a1 - c.a0;
    const double bulge_b = wb > 0 ? along.at(c.b0, c.b1) * wb * wb / 8 : 0.0;
    const double bulge_a = wa > 0 ? beside.at(c.a0, c.a1) * wa * wa / 8 : 0.0;
    const double bound = c.ends() + bulge_a + bulge_b;
    if (!(bound > found + slack) || !(c.ends() <= tolerance_) || depth == 0) return bound;
    Cell first = c, second = c;
    if (bulge_b >= bulge_a) {
      first.b1 = second.b0 = 0.5 * (c.b0 + c.b1);
      const Nearest n = nearest(given_[c.given].curve(), c.a0, c.a1, path_[c.path].curve().at(first.b1).value);
      first.a1 = second.a0 = n.u;
      first.d1 = second.d0 = n.distance;
    } else {
      first.a1 = second.a0 = 0.5 * (c.a0 + c.a1);
      const Nearest n = nearest(path_[c.path].curve(), c.b0, c.b1, given_[c.given].curve().at(first.a1).value);
      first.b1 = second.b0 = n.u;
      first.d1 = second.d0 = n.distance;
    }
    if (first.d1 <= tolerance_) found = std::max(found, first.d1);
    const double left = refine(first, along, beside, slack, found, depth - 1);
    const double right = refine(second, along, beside, slack, found, depth - 1);
    return std::isnan(left) || left > right ? left : right;
  }

  bool short_enough(const Cell& c) const {
    const Segment &b = path_[c.path], &a = given_[c.given];
    return b.arc_length(c.b1) - b.arc_length(c.b0) <= longest * tolerance_ &&
           a.arc_length(c.a1) - a.arc_length(c.a0) <= longest * tolerance_;
  }

  /// Upper bound of the distances from one curve's [u0, u1] to the limbs of the other around `centre`, at most some
  /// tolerances further along it. The distance changes no faster than the way along the curve.
  double stray(const Path& one, const Limb& limb, double u0, double u1, const Path& other,
               const std::vector<Limb>& others, std::size_t centre, double slack, double& found) const {
    const double window = reach_back * tolerance_ + limb.length;
    std::size_t first = centre, last = centre;
    for (double way = 0; first > 0 && way <= window; way += others[first].length) --first;
    for (double way = 0; last + 1 < others.size() && way <= window; way += others[last].length) ++last;
    const Segment& segment = one[limb.segment];
    const auto bound = [&](const auto& self, double a, double b, int depth) -> double {
      const double middle = 0.5 * (a + b), half = 0.5 * (segment.arc_length(b) - segment.arc_length(a));
      const Vec p = segment.curve().at(middle).value;
      double d = HUGE_VAL;
      for (std::size_t k = first; k <= last; ++k)
        d = std::min(d, nearest(other[others[k].segment].curve(), others[k].u0, others[k].u1, p).distance);
      found = std::max(found, d);
      if (!(d + half > std::max(found + slack, close * tolerance_)) || !(d <= tolerance_) || depth == 0)
        return d + half;
      return std::max(self(self, a, middle, depth - 1), self(self, middle, b, depth - 1));
    };
    return bound(bound, u0, u1, cell_depth);
  }

  const Path &given_, &path_;
  double tolerance_;
  Progress& progress_;
  double from_, to_;
  std::vector<Limb> limbs_, links_;  ///< of the contour, of the path
  std::vector<Cell> cells_;
  Choice choice_{};
};

}  // namespace

Check tube_check(const Contour& given, const Contour& path, double tolerance, Progress& progress, double from,
                 double to) {
  Check check = verify::make_check("deviation from contour", "mm", tolerance,
                                   Tube(given, path, tolerance, progress, from, to).run());
  progress.report("verify", to);
  return check;
}

}  // namespace bahnwerk
