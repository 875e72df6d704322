#include "core/redundant/methods/reversed_task.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/geometry/curve/reversed.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/redundant/coarse/carried_motion.hpp"
#include "core/redundant/reversed_motion.hpp"

namespace bahnwerk {
namespace {

Contour reversed(const Contour& contour) {
  Contour back;
  back.dimension = contour.dimension;
  back.height = contour.height;
  const std::size_t n = contour.path.size(), blocks = contour.blocks.size();
  for (std::size_t i = n; i-- > 0;)
    back.path.append(bahnwerk::reversed(contour.path[i].curve()), contour.path[i].source());
  for (std::size_t i = blocks; i-- > 0;) {
    Block block = contour.blocks[i];
    block.first = n - contour.blocks[i].last, block.last = n - contour.blocks[i].first;
    back.blocks.push_back(block);
  }
  for (std::size_t i = contour.rests.size(); i-- > 0;) {
    Rest rest = contour.rests[i];
    rest.segment = n - rest.segment, rest.block = blocks - 1 - rest.block;
    back.rests.push_back(rest);
  }
  return back;
}

template <class T>
std::vector<T> backwards(std::vector<T> list) {
  std::reverse(list.begin(), list.end());
  return list;
}

/// Returns the length, mm, by which a piece's polynomial advances.
double way(const LawPiece& p) {
  return p.duration * (p.v + p.duration * (p.a / 2 + p.duration * (p.j / 6 + p.duration * p.snap / 24)));
}

/// Lengthens a piece by `more` mm, added as a motion from rest to rest in three parts, so that its speed and
/// acceleration at both ends stay.
std::array<LawPiece, 3> with_more(const LawPiece& p, double more) {
  const double d = p.duration, jerk = 32 * more / (d * d * d);
  std::array<LawPiece, 3> parts{p, p, p};
  LawState x{0, 0, 0, jerk};  // state of the added motion
  double t = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    LawPiece& part = parts[i];
    const LawState at = p.at(t);
    const double h = i == 1 ? d / 2 : d / 4, j = i == 1 ? -jerk : jerk;
    part.duration = h;
    part.v = at.v + x.v, part.a = at.a + x.a, part.j = at.j + j;
    x.v += h * (x.a + h * j / 2), x.a += h * j;
    t += h;
  }
  return parts;
}

/// Reverses a time law: each piece runs from its end to its begin. Path lengths are counted from the other end, so
/// rounding near the new begin is finer than it was in the original law.
class ReversedLaw {
 public:
  /// `begins` receives the reversed begin of each piece of the law.
  ReversedLaw(const TimeLaw& law, const AxisPath& planned, const AxisPath& path, std::vector<double>& begins)
      : law_(law), planned_(planned), path_(path), begins_(begins) {
    begins_.resize(law.pieces().size());
  }

  TimeLaw run() {
    const auto& pieces = law_.pieces();
    back_.reserve(pieces.size() + path_.size());
    for (std::size_t i = pieces.size(); i-- > 0;) {
      const LawPiece& p = pieces[i];
      const std::size_t segment = path_.size() - 1 - p.segment;
      if (dwells(p)) {
        stand(i, segment);
        continue;
      }
      if (!moving_.empty() && moving_.front().segment != segment) move();
      const LawState end = p.at(p.duration);
      const double behind = i + 1 < pieces.size() ? pieces[i + 1].v : 0;
      LawPiece piece;
      piece.segment = segment;
      piece.duration = p.duration;
      piece.v = behind == 0 || p.v > 0 ? behind : end.v;  // at rest exactly, at its begin or at its end
      piece.a = -end.a, piece.j = end.j, piece.snap = -p.snap;
      moving_.push_back(piece);
      numbers_.push_back(i);
    }
    move();
    return std::move(back_);
  }

 private:
  /// Returns the segment of a dwell: the one that begins where it lasts, or the last one.
  void stand(std::size_t number, std::size_t segment) {
    move();
    const LawPiece& p = law_.pieces()[number];
    begins_[number] = back_.duration();
    LawPiece piece;
    const bool at_begin = p.s <= planned_[p.segment].s0();
    piece.segment = std::min(at_begin ? segment + 1 : segment, path_.size() - 1);
    piece.s = piece.s_end = back_.pieces().empty() ? 0 : back_.pieces().back().s_end;
    piece.duration = p.duration;
    back_.append(piece);
  }

  /// Adds all pieces of a segment; the longest piece absorbs the rounding error of the segment's length.
  void move() {
    if (moving_.empty()) return;
    const Segment& segment = path_[moving_.front().segment];
    double all = 0;
    std::size_t longest = 0;
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      all += way(moving_[i]);
      if (moving_[i].duration > moving_[longest].duration) longest = i;
    }
    const double more = segment.length() - all;
    double s = segment.s0(), gone = 0;
    const auto add = [&](LawPiece piece, bool last) {
      gone += way(piece);
      piece.s = s;
      piece.s_end = s = last ? segment.s1() : std::min(segment.s0() + gone, segment.s1());
      back_.append(piece);
    };
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      const bool last = i + 1 == moving_.size();
      begins_[numbers_[i]] = back_.duration();
      if (i != longest || more == 0) {
        add(moving_[i], last);
        continue;
      }
      const std::array<LawPiece, 3> parts = with_more(moving_[i], more);
      for (std::size_t k = 0; k < 3; ++k) add(parts[k], last && k == 2);
    }
    moving_.clear();
    numbers_.clear();
  }

  const TimeLaw& law_;
  const AxisPath &planned_, &path_;
  std::vector<double>& begins_;
  TimeLaw back_;
  std::vector<LawPiece> moving_;      // pieces of one segment whose places are not set yet
  std::vector<std::size_t> numbers_;  // their indices in the law
};

/// Returns the reversed motion that belongs to the reversed law. Its parts end where pieces of either end, so a part's
/// duration is exact up to the rounding of two times, independently of the rounding of sums. `begins` are the reversed
/// begins of the law's pieces.
std::vector<ReversedMotion::Part> parts_of(const Motion& motion, const TimeLaw& law,
                                           const std::vector<double>& begins) {
  const auto& pieces = law.pieces();
  const double same = 64 * std::numeric_limits<double>::epsilon() * law.duration();
  std::vector<ReversedMotion::Part> parts;
  std::size_t i = pieces.size() - 1, k = motion.pieces() - 1;
  parts.push_back({k, motion.duration(), 0});
  for (;;) {
    const double law_begin = pieces[i].t0, own_begin = motion.begin(k);
    const bool law_ends = i > 0 && law_begin >= own_begin - same, own_ends = k > 0 && own_begin >= law_begin - same;
    if (!law_ends && !own_ends) return parts;
    const double begins_at = law_ends ? begins[i - 1] : begins[i] + (pieces[i].t0 + pieces[i].duration - own_begin);
    if (own_ends) --k;
    if (law_ends) --i;
    parts.push_back({k, own_ends ? motion.end(k) : law_begin, begins_at});
  }
}

/// Removes the rounding error of velocity and acceleration with which an axis begins instead of rest: adds e with e′(0)
/// = −v, e′(h) = 0, and for order 3, where accelerations are continuous, e″(0) = −a, e″(h) = 0.
void begin_at_rest(Polynomial& p, double h, int order) {
  const double v = p.size() > 1 ? p[1] : 0, a = order == 3 && p.size() > 2 ? 2 * p[2] : 0;
  if (v == 0 && a == 0) return;
  if (order == 3)
    p = p + Polynomial{0, -v, -a / 2, (3 * v + 2 * a * h) / (3 * h * h), -(2 * v + a * h) / (4 * h * h * h)};
  else
    p = p + Polynomial{0, -v, v / (2 * h)};
  p[1] = 0;
  if (order == 3 && p.size() > 2) p[2] = 0;
}

/// Reverses a polynomial motion that begins at rest.
std::shared_ptr<const SplineMotion> spline(const Motion& motion, int order) {
  std::vector<SplineMotion::Piece> pieces;
  pieces.reserve(motion.pieces());
  for (std::size_t i = 0; i < motion.pieces(); ++i) {
    // Times are counted from the other end, so the shortest pieces may vanish by rounding.
    if (!(motion.end(i) > (pieces.empty() ? 0 : pieces.back().end))) continue;
    SplineMotion::Piece& piece = pieces.emplace_back();
    piece.end = motion.end(i);
    piece.axes.resize(motion.axes());
    for (std::size_t k = 0; k < motion.axes(); ++k)
      if (!motion.polynomial(i, k, piece.axes[k])) return nullptr;
  }
  for (Polynomial& p : pieces.front().axes) begin_at_rest(p, pieces.front().end, order);
  return std::make_shared<const SplineMotion>(std::move(pieces));
}

}  // namespace

std::optional<RedundancyTask> reversed(const RedundancyTask& task) {
  const auto contour = std::make_shared<const Contour>(reversed(*task.contour));
  const std::size_t n = task.path->size();
  if (contour->path.size() != n) return std::nullopt;
  RedundancyTask back{contour_axes(contour, task.path->axes()),
                      contour,
                      task.machine,
                      backwards(task.feeds),
                      backwards(task.rests),
                      backwards(task.dwells)};
  for (Rest& rest : back.dwells) rest.segment = n - rest.segment, rest.block = contour->blocks.size() - 1 - rest.block;
  back.bound = task.bound;
  return back;
}

RedundancyResult reversed(RedundancyResult found, const RedundancyTask& task) {
  const std::size_t n = task.path->size();
  const TimeLaw& law = found.head->law();
  std::vector<double> begins;
  auto head =
      std::make_shared<const PathMotion>(task.path, ReversedLaw(law, found.head->path(), *task.path, begins).run());
  const auto back = [&](const std::shared_ptr<const Motion>& motion) {
    return std::make_shared<const ReversedMotion>(motion, parts_of(*motion, law, begins), head->duration());
  };
  const int order = task.machine.limited_order();
  // Carried axes follow the task's own path exactly.
  if (found.coarse == found.head) {
    found.coarse = head;
  } else if (const auto* carried = dynamic_cast<const CarriedMotion*>(found.coarse.get())) {
    const auto split = carried->split() ? spline(*back(carried->split()), order) : nullptr;
    found.coarse = std::make_shared<const CarriedMotion>(head, split, carried->carried());
  } else {
    const auto reversed_coarse = back(found.coarse);
    found.coarse = spline(*reversed_coarse, order);
    if (!found.coarse) found.coarse = reversed_coarse;
  }
  found.head = std::move(head);
  for (SlowedSegment& slowed : found.slowed) slowed.segment = n - 1 - slowed.segment;
  std::reverse(found.slowed.begin(), found.slowed.end());
  return found;
}

}  // namespace bahnwerk
