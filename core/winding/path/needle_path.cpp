#include "core/winding/path/needle_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/geometry/spline/link.hpp"
#include "core/geometry/spline/spline_arc.hpp"
#include "core/winding/part/vec3.hpp"
#include "core/winding/path/link_search.hpp"

namespace bahnwerk::winding {
namespace {

// A memory of links for congruent ends: rotated about the part's axis, or mirrored by a plane through it. All links of
// coils that are repeated around the part have such ends. The smoothness of a link depends neither on its place nor on
// its orientation.

class KnownLinks {
 public:
  explicit KnownLinks(std::size_t continuity) : continuity_(continuity) {}
  /// Returns the first remembered link that joins such ends. O(log n).
  const FoundLink* find(const LinkEnds& ends) const;
  void remember(const LinkEnds& ends, const FoundLink& link);

 private:
  struct Known {
    LinkEnds ends;
    FoundLink link;
  };
  std::size_t continuity_;
  std::multimap<double, Known> by_chord_;
};

constexpr double alike = 1e-11;

double chord(const LinkEnds& ends) { return norm(place(ends.after[0]) - place(ends.before[0])); }

/// Returns whether `b` is `a` rotated about the z axis, or mirrored by a plane through it, to 1e-11: places relative to
/// the distance of both ends, each derivative up to `continuity` relative to the first one. Angles of the needle do not
/// count.
bool congruent(const LinkEnds& a, const LinkEnds& b, std::size_t continuity) {
  const Vec from = place(a.before[0]), to = place(b.before[0]);
  const double size = std::hypot(from.x, from.y) * std::hypot(to.x, to.y), distance = chord(a);
  // Compares as complex numbers: b = e^{iθ} a, or the conjugate of a.
  const auto alike_by = [&](double hand) {
    const double c = (from.x * to.x + hand * from.y * to.y) / size, s = (from.x * to.y - hand * from.y * to.x) / size;
    const auto same = [&](const SplineJet& x, const SplineJet& y) {
      const double way = norm(place(x[1]));
      for (std::size_t j = 0; j <= continuity; ++j) {
        const Vec p = place(x[j]), moved{c * p.x - s * hand * p.y, s * p.x + c * hand * p.y, p.z};
        if (!(norm(moved - place(y[j])) <= alike * (j == 0 ? distance : way))) return false;
      }
      return true;
    };
    return same(a.before, b.before) && same(a.after, b.after);
  };
  return alike_by(1) || alike_by(-1);
}

const FoundLink* KnownLinks::find(const LinkEnds& ends) const {
  const double length = chord(ends), slack = 4 * alike * length;
  for (auto i = by_chord_.lower_bound(length - slack); i != by_chord_.end() && i->first <= length + slack; ++i)
    if (congruent(i->second.ends, ends, continuity_)) return &i->second.link;
  return nullptr;
}

void KnownLinks::remember(const LinkEnds& ends, const FoundLink& link) {
  by_chord_.emplace(chord(ends), Known{ends, link});
}

constexpr double pi = std::numbers::pi;
constexpr double shortest = 1e-6;  // mm, of a piece or of a link's chord
constexpr double unlimited = std::numeric_limits<double>::infinity();

SplinePoint point(const NeedlePose& pose) { return {pose.tip.x, pose.tip.y, pose.tip.z, pose.phi, pose.psi}; }

bool is_slot(const FixedPiece& piece) { return piece.kind == FixedPiece::Kind::region && piece.region % 2 == 0; }

/// Returns the curve of a fixed piece; empty if it has no length.
std::vector<BezierPiece> curve(const FixedPiece& piece, std::size_t continuity) {
  const SplinePoint from = point(piece.begin.pose), to = point(piece.end.pose);
  if (piece.shape == FixedPiece::Shape::line) {
    if (!(norm(place(to) - place(from)) > shortest)) return {};
    return {BezierPiece::line(from, to)};
  }
  if (!(std::hypot(from[0], from[1]) * std::abs(piece.sweep) > shortest)) return {};
  return spline_arc(from, {0, 0, from[2]}, {0, 0, 1}, piece.sweep,
                    {0, 0, to[2] - from[2], piece.sweep, to[4] - from[4]}, continuity);
}

/// Returns the extra point on the slot's radius, towards that of the other piece [Herrmann 4.3.4].
ExtraPoint on_the_radius(const Way& way, double share) {
  const Vec3 a = way.slot.tip, b = way.head.tip;
  return {azimuth(a), std::hypot(a.x, a.y) + share * std::hypot(b.x - a.x, b.y - a.y)};
}

/// Returns the pose in which a stator's needle has finished its swivel when it leaves a slot, or begins it when it
/// enters: at the height of the winding head. The needle passes it on a radius, without curvature and without turning.
SplineJet extra_pose(const Way& way, const ExtraPoint& at, bool inwards) {
  const double phi = way.slot.phi + std::remainder(at.azimuth - way.slot.phi, 2 * pi), sense = inwards ? -1 : 1;
  const Vec3 out = radial(at.azimuth), tip = at.radius * out;
  SplineJet jet{};
  jet[0] = {tip.x, tip.y, way.head.tip.z, phi, way.head.psi};
  jet[1] = {sense * out.x, sense * out.y, 0, 0, 0};
  return jet;
}

class Maker {
 public:
  Maker(const std::vector<FixedPiece>& fixed, bool stator, const LinkOptions& options, const PostPassage* posts)
      : fixed_(fixed), stator_(stator), options_(options), posts_(posts), search_(options) {}

  Expected<NeedlePath, NoPath> run(Progress progress) {
    std::vector<BezierPiece> here = curve(fixed_.front(), options_.continuity);
    for (std::size_t i = 0;; ++i) {
      if (here.empty()) return NoPath{NoPath::Reason::no_length, i};
      for (BezierPiece& piece : here) path_.pieces.push_back({piece, i, false, 0});
      if (i + 1 == fixed_.size()) return std::move(path_);
      std::vector<BezierPiece> next = curve(fixed_[i + 1], options_.continuity);
      const double done = static_cast<double>(i) / static_cast<double>(fixed_.size());
      const Progress at = progress.part(done, done).named("link");  // a search does not know when it ends
      if (next.empty()) return NoPath{NoPath::Reason::no_length, i + 1};
      if (const auto none = join(i, here.back(), next.front(), at)) return *none;
      here = std::move(next);
    }
  }

 private:
  /// Key of a link: kind and region of the piece that it comes from, kind of the piece that it leads to, and its part.
  using Place = std::tuple<FixedPiece::Kind, std::size_t, FixedPiece::Kind, std::size_t>;
  /// A candidate link.
  struct Found {
    LinkEnds ends;
    FoundLink link;
    BezierPiece piece;
  };
  using Both = std::array<std::optional<Found>, 2>;  // none: the needle does not fit
  /// The passage of a post at the same place of the turn before.
  struct Passed {
    std::optional<std::size_t> place;  ///< place of PostPassage::beside(); none: the point was on the slot's radius
    bool exhausted = false;            ///< no place was enough
  };

  /// Appends the links behind fixed piece i. Returns why there are none.
  std::optional<NoPath> join(std::size_t i, const BezierPiece& before, const BezierPiece& after, Progress progress) {
    const FixedPiece &from = fixed_[i], &to = fixed_[i + 1];
    const SplineJet begin = before.at(1), end = after.at(0);
    const bool out = is_slot(from);
    if (!(stator_ && options_.extra_point > 0 && out != is_slot(to)))
      return take(i, find(i, 0, {begin, end}, progress), 1);
    const FixedPiece& slot = out ? from : to;
    const Way way{slot.coil, slot.region == 2, out ? from.end.pose : to.begin.pose,
                  out ? to.begin.pose : from.end.pose};
    const Both both = past_the_post(
        i, way,
        [&](const ExtraPoint& point) {
          const SplineJet middle = extra_pose(way, point, !out);
          return Both{find(i, 0, {begin, middle}, progress), find(i, 1, {middle, end}, progress)};
        },
        progress);
    if (const auto none = take(i, both[0], out ? 1 : 0)) return none;
    return take(i, both[1], out ? 0 : 1);
  }

  /// `links(point)` returns both links by way of a point. The source's point is used wherever the needle keeps its
  /// distance from the posts with it; otherwise the first place beside the post with enough distance, or the one with
  /// the largest.
  template <class Links>
  Both past_the_post(std::size_t i, const Way& way, const Links& links, Progress progress) {
    const ExtraPoint source = on_the_radius(way, options_.extra_point);
    if (posts_ == nullptr) return links(source);
    const auto room = [&](const Both& both, bool posts_only) {
      if (!both[0] || !both[1] || both[0]->link.cusped() || both[1]->link.cusped()) return -unlimited;
      const std::array curves{both[0]->piece, both[1]->piece};
      return posts_only ? posts_->from_posts(way.coil, curves, progress) : posts_->from_all(way.coil, curves, progress);
    };
    Passed& passed = passed_[{fixed_[i].kind, fixed_[i].region, fixed_[i + 1].kind, 0}];
    Both best = links(passed.place ? posts_->beside(way, *passed.place) : source);
    if (passed.exhausted) return best;
    double most = room(best, !passed.place);
    for (std::size_t place = 0; most < posts_->enough() && place < PostPassage::places; ++place) {
      Both next = links(posts_->beside(way, place));
      const double left = room(next, false);
      if (left > most) most = left, best = std::move(next), passed.place = place;
    }
    passed.exhausted = most < posts_->enough();
    return best;
  }

  std::optional<Found> find(std::size_t i, std::size_t part, const LinkEnds& ends, Progress progress) {
    const FixedPiece &from = fixed_[i], &to = fixed_[i + 1];
    if (!(norm(place(ends.after[0]) - place(ends.before[0])) > shortest)) return std::nullopt;
    // The link at this place of the turn before is nearly equal; that of a previous coil may be exactly equal.
    const Place at{from.kind, from.region, to.kind, part};
    std::optional<FoundLink>& known = known_[at];
    KnownLinks& all = all_.try_emplace(at, options_.continuity).first->second;
    const FoundLink* same = all.find(ends);
    const FoundLink found = same != nullptr ? *same : search_.find(ends, known, progress);
    if (same == nullptr) all.remember(ends, found);
    known.reset();
    if (!found.cusped()) known = found;
    return Found{ends, found, link(options_.continuity, ends, found.best.shape)};
  }
  std::optional<NoPath> take(std::size_t i, const std::optional<Found>& found, double share) {
    if (!found) return NoPath{NoPath::Reason::no_room, i};
    if (found->link.cusped()) return NoPath{NoPath::Reason::cusp, i};
    path_.links.push_back({i, path_.pieces.size(), found->ends, found->link.best, turned_angle(found->piece)});
    path_.pieces.push_back({found->piece, i, true, share});
    return std::nullopt;
  }

  const std::vector<FixedPiece>& fixed_;
  bool stator_;
  const LinkOptions& options_;
  const PostPassage* posts_;
  LinkSearch search_;
  std::map<Place, std::optional<FoundLink>> known_;
  std::map<Place, KnownLinks> all_;
  std::map<Place, Passed> passed_;
  NeedlePath path_;
};

}  // namespace

std::size_t coil_of(const NeedlePiece& piece, const std::vector<FixedPiece>& fixed) {
  const FixedPiece& from = fixed[piece.fixed];
  return piece.link && from.kind == FixedPiece::Kind::coil_change ? fixed[piece.fixed + 1].coil : from.coil;
}

std::vector<BezierPiece> NeedlePath::curves() const {
  std::vector<BezierPiece> all;
  all.reserve(pieces.size());
  for (const NeedlePiece& piece : pieces) all.push_back(piece.curve);
  return all;
}

NurbsPath NeedlePath::united() const { return bahnwerk::united(curves()); }

Expected<NeedlePath, NoPath> needle_path(const std::vector<FixedPiece>& pieces, bool stator, const LinkOptions& options,
                                         Progress progress, const PostPassage* posts) {
  std::vector<InputFault> faults;
  if (options.continuity < 1 || options.continuity > 4)
    faults.push_back({{"path", "continuity"}, "is not a whole number from 1 to 4"});
  if (!(options.extra_point >= 0 && options.extra_point <= 1))
    faults.push_back({{"path", "extra_point"}, "is not a number from 0 to 1"});
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  if (pieces.empty()) return NeedlePath{};
  return Maker(pieces, stator, options, posts).run(progress);
}

}  // namespace bahnwerk::winding
