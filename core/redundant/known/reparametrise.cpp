#include "core/redundant/known/reparametrise.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/progress_scope.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/axes/hermite_motion.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/motion/law/law_between.hpp"
#include "core/redundant/known/quicker_ranges.hpp"
#include "core/redundant/known/split_peaks.hpp"
#include "core/redundant/known/timed_ends.hpp"
#include "core/redundant/known/timed_path.hpp"

namespace bahnwerk {
namespace {

constexpr double first_margin = 1e-6, last_margin = 0.05;  // relative margins of all limits
constexpr double exceeded = 1e-5;         // relative excess of a peak that the plan removes by slowing the whole motion
constexpr double longest_piece = 0.5e-3;  // s, longest piece of the new motion
constexpr double shortest_way = 1e-9;     // path length of the last piece before a rest, at least

/// Returns the largest rate of the old time on each interval, mm/s of the timed path: the head keeps its feed and
/// dwells keep their durations.
std::vector<double> rates(const TimedPath& path, const TimeLaw& law, const RedundancyTask& task) {
  std::vector<double> feeds;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const TimedPath::SmoothInterval& interval = path.interval(i);
    const LawPiece& piece = law.pieces()[interval.head];
    double fastest = 0;
    const auto look = [&](double tau) { fastest = std::fmax(fastest, std::abs(piece.at(tau).v)); };
    look(interval.begin - piece.t0), look(interval.end - piece.t0);
    for (const double tau : turning_points(piece))
      if (tau > interval.begin - piece.t0 && tau < interval.end - piece.t0) look(tau);
    const double rate = piece.s_end == piece.s ? 1 : std::fmin(fastest_rate, task.feeds[piece.segment] / fastest);
    feeds.push_back(rate * TimedPath::per_second);
  }
  return feeds;
}

/// Builds head and coarse motion for the new law of the old time.
struct Retimed {
  TimeLaw law;
  std::vector<SplineMotion::Piece> coarse;
  std::vector<double> times;  // s, ends of ranges
};

class Driver {
 public:
  Driver(const RedundancyResult& old, const TimedPath& path) : old_(old), path_(path) {}

  /// `marks` are ascending indices of pieces of `rate`; out.times receives their begins.
  Retimed run(const TimeLaw& rate, const std::vector<std::size_t>& marks, ProgressScope& scope) {
    auto mark = marks.begin();
    for (std::size_t n = 0; n < rate.pieces().size(); ++n) {
      const LawPiece& p = rate.pieces()[n];
      for (; mark != marks.end() && *mark == n; ++mark) out_.times.push_back(out_.law.duration());
      const auto parts = static_cast<std::size_t>(std::ceil(std::fmax(1.0, p.duration / longest_piece)));
      const double h = p.duration / static_cast<double>(parts);
      for (std::size_t i = 0; i < parts; ++i)
        drive(p.segment, state(p, h * static_cast<double>(i)),
              state(p, i + 1 == parts ? p.duration : h * static_cast<double>(i + 1)), h);
      scope.work(16 * parts);
    }
    for (; mark != marks.end(); ++mark) out_.times.push_back(out_.law.duration());
    return std::move(out_);
  }

 private:
  struct Both {
    LawState head;
    MotionState coarse;
  };

  /// Returns the states of all axes at the new time tau in a piece of the law.
  Both state(const LawPiece& p, double tau) const {
    const TimedPath::SmoothInterval& interval = path_.interval(p.segment);
    const LawState x = p.at(tau);
    const LawPiece& piece = old_.head->law().pieces()[interval.head];
    double at = std::clamp(x.s / TimedPath::per_second, interval.begin, interval.end);
    if (tau == p.duration && p.s_end == path_[p.segment].s1()) at = interval.end;
    // Ends of pieces of the old law are reproduced exactly, rests in particular.
    const double from = at - piece.t0, there = at == old_.head->end(interval.head) ? piece.duration : from;
    const double w = x.v / TimedPath::per_second, dw = x.a / TimedPath::per_second;
    Both both{piece.at(at == piece.t0 ? 0 : there), old_.coarse->in_piece(interval.coarse, at)};
    if (there == piece.duration) {
      both.head.s = piece.s_end;
      if (ends_at_rest(interval.head)) both.head.v = 0;
    }
    both.head.a = both.head.a * w * w + both.head.v * dw;
    both.head.v *= w;
    for (std::size_t k = 0; k < old_.coarse->axes(); ++k) {
      both.coarse[2][k] = both.coarse[2][k] * w * w + both.coarse[1][k] * dw;
      both.coarse[1][k] *= w;
    }
    return both;
  }

  bool ends_at_rest(std::size_t piece) const {
    const auto& pieces = old_.head->law().pieces();
    return piece + 1 == pieces.size() || pieces[piece + 1].v == 0;
  }

  /// Appends pieces from state to state; each begins exactly where the one before ended.
  void drive(std::size_t interval, Both left, const Both& right, double h) {
    if (!(h > 0)) return;
    const LawPiece& old = old_.head->law().pieces()[path_.interval(interval).head];
    const double time = out_.law.duration();
    if (!out_.law.pieces().empty()) {
      const LawPiece& before = out_.law.pieces().back();
      const LawState end = before.at(before.duration);
      left.head.s = before.s_end;
      if (left.head.v != 0) left.head.v = end.v;
    }
    if (old.s_end > old.s) {
      if (!(right.head.s > left.head.s)) {
        if (right.head.v == 0) come_to_rest(old.segment, right, h);
        return;
      }
      append_between(out_.law, old.segment, left.head, right.head, h);
    } else {
      stand(path_.interval(interval).head, left.head.s, h);
    }
    append_coarse(time, left, right);
  }

  void append_coarse(double time, Both left, const Both& right) {
    const double end = out_.law.duration();
    SplineMotion::Piece piece{end, {}};
    if (!out_.coarse.empty()) join(out_.coarse.back(), time - begin_, 0, left.coarse);
    for (std::size_t k = 0; k < old_.coarse->axes(); ++k)
      piece.axes.push_back(hermite_quintic(end - time, left.coarse, right.coarse, k));
    out_.coarse.push_back(std::move(piece));
    begin_ = time;
  }

  /// Appends a dwell as one piece, however many intervals it covers.
  void stand(std::size_t old, double s, double h) {
    LawPiece piece;
    piece.s = piece.s_end = s, piece.duration = h, piece.segment = old_.head->law().pieces()[old].segment;
    const auto& pieces = out_.law.pieces();
    if (!pieces.empty() && dwells(pieces.back()) && stands_ == old) {
      piece.duration += pieces.back().duration;
      out_.law.truncate(pieces.size() - 1);
    }
    stands_ = old;
    out_.law.append(piece);
  }

  /// The last piece before a rest is too short for path lengths to resolve, so it is joined with the piece before it.
  void come_to_rest(std::size_t segment, const Both& right, double h) {
    const auto& pieces = out_.law.pieces();
    const double shortest = shortest_way * std::abs(right.head.s);
    while (!pieces.empty() && !dwells(pieces.back()) && pieces.back().segment == segment) {
      const LawPiece last = pieces.back();
      h += last.duration;
      Both left{last.at(0), coarse_begin(out_.coarse.back())};
      out_.law.truncate(pieces.size() - 1);
      out_.coarse.pop_back();
      begin_ = out_.coarse.size() < 2 ? 0 : out_.coarse[out_.coarse.size() - 2].end;
      if (right.head.s - left.head.s <= shortest && last.v > 0) continue;
      const double time = out_.law.duration();
      append_between(out_.law, segment, left.head, right.head, h);
      append_coarse(time, left, right);
      return;
    }
  }
  MotionState coarse_begin(const SplineMotion::Piece& piece) const {
    MotionState x;
    for (std::size_t k = 0; k < piece.axes.size(); ++k) {
      const Polynomial& p = piece.axes[k];
      x[0][k] = p[0], x[1][k] = p.size() > 1 ? p[1] : 0, x[2][k] = p.size() > 2 ? 2 * p[2] : 0;
    }
    return x;
  }

  const RedundancyResult& old_;
  const TimedPath& path_;
  Retimed out_;
  std::size_t stands_ = 0;  // old piece of the last dwell
  double begin_ = 0;        // s, begin of the last coarse piece
};

/// The ranges of the old time that may be traversed more quickly, and those for which all limits hold.
class Retiming {
 public:
  Retiming(const RedundancyResult& old, const TimedPath& path, const RedundancyTask& task, ProgressScope& scope)
      : old_(old), path_(path), task_(task), scope_(scope), open_{{0, path.length(), {}}} {}

  /// Accepts the ranges that keep the limits; the others stay open. Returns the least quotient of a peak and its limit
  /// among the open ones; 0: none is open.
  double add(std::vector<QuickerRange> ranges) {
    std::erase_if(ranges, [&](const QuickerRange& r) {
      return std::none_of(open_.begin(), open_.end(),
                          [&](const QuickerRange& o) { return o.begin <= r.begin && r.end <= o.end; });
    });
    if (ranges.empty()) return 0;
    const Retimed tried = driven(ranges);
    const PathMotion head(task_.path, tried.law);
    const SplineMotion coarse(tried.coarse);
    const std::vector<std::vector<RedundancyPeaks>> peaks = split_peaks(head, coarse, tried.times, scope_);
    open_.clear();
    double least = 0;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double use = use_of(peaks[2 * i + 1], task_.machine).most();
      if (use > 1 + exceeded && (least == 0 || use < least)) least = use;
      (use <= 1 + exceeded ? taken_ : open_).push_back(std::move(ranges[i]));
    }
    return least;
  }
  /// Returns the largest quotient of a peak and its limit.
  double use(const Retimed& tried) const {
    const PathMotion head(task_.path, tried.law);
    const SplineMotion coarse(tried.coarse);
    return use_of(split_peaks(head, coarse, scope_), task_.machine).most();
  }
  bool gains_nothing() const { return taken_.empty(); }
  Retimed result() {
    std::sort(taken_.begin(), taken_.end(),
              [](const QuickerRange& a, const QuickerRange& b) { return a.begin < b.begin; });
    return driven(taken_);
  }

 private:
  Retimed driven(const std::vector<QuickerRange>& ranges) const {
    std::vector<std::size_t> marks;
    const TimeLaw law = with_ranges(path_, ranges, marks);
    return Driver(old_, path_).run(law, marks, scope_);
  }

  const RedundancyResult& old_;
  const TimedPath& path_;
  const RedundancyTask& task_;
  ProgressScope& scope_;
  std::vector<QuickerRange> open_, taken_;
};

}  // namespace

RedundancyResult reparametrised(RedundancyResult found, const RedundancyTask& task, Progress progress) {
  std::vector<TimedPath::SmoothInterval> intervals = TimedPath::smooth_intervals(*found.head, *found.coarse);
  const Path tool = TimedPath::tool_path(intervals);
  const TimedPath path(tool, *found.head, *found.coarse, std::move(intervals));
  const std::vector<double> feeds = rates(path, found.head->law(), task);
  Progress planning = progress.part(0, 0.5);
  ProgressScope scope(progress.part(0.5, 1), "planning");
  Retiming timing(found, path, task, scope);
  std::optional<Retimed> whole;
  for (double margin = first_margin; margin <= last_margin;) {
    const Machine machine = both_stages(task.machine, 1 - margin);
    const PathTask again{path, machine, feeds, std::vector<bool>(path.size() + 1, false)};
    const TimeLaw rate = with_moving_ends(plan_acceleration_limited(again, {}, planning).law, path, machine);
    double use = timing.add(quicker_ranges(rate));
    if (!whole) {
      Retimed tried = Driver(found, path).run(rate, {}, scope);
      const double all = timing.use(tried);
      if (all <= 1 + exceeded)
        whole = std::move(tried);
      else
        use = use > 1 ? std::fmin(use, all) : all;
    }
    if (use <= 1) break;
    margin = std::fmax(10 * margin, 1.2 * (use - 1));
    planning = progress.part(0.5, 0.5);
  }
  std::optional<Retimed> best;
  if (!timing.gains_nothing()) best = timing.result();
  if (whole && (!best || whole->law.duration() < best->law.duration())) best = std::move(whole);
  if (!best || !(best->law.duration() < found.head->duration())) {
    found.notes.emplace_back("Timing the finished motion anew made it no shorter.");
    return found;
  }
  RedundancyIteration pass;
  const auto head = std::make_shared<const PathMotion>(task.path, std::move(best->law));
  const auto coarse = std::make_shared<const SplineMotion>(std::move(best->coarse));
  pass.duration = head->duration();
  pass.peaks = split_peaks(*head, *coarse, scope);
  found.passes.push_back(std::move(pass));
  found.head = head, found.coarse = coarse;
  found.trades.clear();
  return found;
}

}  // namespace bahnwerk
