#include "core/contour/blend.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/contour/blend/layout.hpp"
#include "core/contour/blend/note.hpp"
#include "core/contour/blend/smooth_run.hpp"

namespace bahnwerk {

namespace {

using namespace blending;

constexpr double min_tolerance = 1e-5, max_tolerance = 1e3;  // mm
constexpr double tiny_share = 0.01;                          // part of the tolerance below which lines are merged
constexpr double used_share = 0.98;                          // part of the tolerance that blends use, after merging
constexpr double fitted_share = 0.984;                       // part of the tolerance that a blend is proven to keep
constexpr double reversal = 170 * 3.14159265358979323846 / 180;
constexpr double fastest = 1e6;           // mm/s, where nothing limits the speed
constexpr double shortest_rest = 1e-9;    // mm of a segment that is worth keeping between two blends
constexpr double shortest_change = 1e-4;  // mm; in less the rounding of coordinates shows in a curve's direction
constexpr int max_attempts = 12;          // attempts at the length of a blend
constexpr int max_splits = 4;             // times that a run is cut where it cannot be smoothed
constexpr std::size_t progress_step = 256;

class Blender {
 public:
  Blender(const Contour& given, const BlendOptions& options, const ToolLimitsMap& limits, Progress progress,
          std::vector<BlendSection>* sections)
      : given_(given), options_(options), limits_(limits), progress_(progress, "blend"), sections_(sections) {
    result_.dimension = given.dimension;
    result_.height = given.height;
    rest_ = given.rest_places();
    result_.notes = given.notes;
    result_.blocks = given.blocks;
    block_.resize(given.path.size());
    for (std::size_t b = 0; b < given.blocks.size(); ++b)
      for (std::size_t i = given.blocks[b].first; i < given.blocks[b].last; ++i) block_[i] = b;
  }

  Contour run() {
    report();
    const std::size_t n = given_.path.size();
    for (std::size_t i = 0; i < n;) {
      take_rests(i);
      std::size_t j = i + 1;
      while (j < n && mode(j) == mode(i) && !rest_[j]) ++j;
      auto list = element_runs(given_.path, i, j, block_, {tiny_share * options_.tolerance, reversal}, progress_);
      list.front().rest_begin = i == 0 || rests(i);
      list.back().rest_end = j == n || rests(j);
      for (const ElementRun& s : list) {
        begin_section(s.elements.front().first);
        process(s, 0);
      }
      i = j;
    }
    take_rests(n);
    end_section(n);
    finish_blocks();
    note(result_, count_, options_, progress_);
    progress_.done(1);
    progress_.report();
    return std::move(result_);
  }

 private:
  /// Begins a section with the given segment i, after the path so far.
  void begin_section(std::size_t i) {
    if (!sections_ || (i > 0 && !rests(i))) return;
    end_section(i);
    sections_->push_back({i, result_.path.size(), false});
    changes_ = count_.corners + count_.runs;
  }
  void end_section(std::size_t i) {
    if (!sections_ || sections_->empty()) return;
    BlendSection& last = sections_->back();
    last.changed = count_.corners + count_.runs != changes_ || result_.path.size() - last.blended != i - last.given;
  }
  Mode mode(std::size_t segment) const {
    return given_.blocks.empty() ? Mode::cut : given_.blocks[block_[segment]].mode;
  }
  /// Returns whether the motion rests at the joint where segment i begins.
  bool rests(std::size_t i) const { return rest_[i] || stops_at(given_.path, i, options_.corner_angle); }
  /// The path passes exactly through the places of rests, which are ends of stretches.
  void take_rests(std::size_t segment) {
    for (std::size_t i = result_.rests.size(); i < given_.rests.size() && given_.rests[i].segment <= segment; ++i)
      result_.rests.push_back({result_.path.size(), given_.rests[i].seconds, given_.rests[i].block});
  }
  void report() {
    progress_.done(
        std::min(1.0, static_cast<double>(done_) / static_cast<double>(std::max<std::size_t>(1, given_.path.size()))));
    progress_.report();
  }
  Ability ability(const Element& element) const {
    const ToolLimits tool = limits_.at([&] { return element.at(0).value; });
    Ability a{std::min(tool.speed, fastest), tool.acceleration, tool.jerk, 0};
    if (!given_.blocks.empty()) a.speed = std::min(a.speed, given_.blocks[element.block].feed);
    a.step = a.speed * limits_.cycle_time;
    a.pull = tool.pull;
    a.corner = options_.corner_angle;
    return a;
  }

  void process(const ElementRun& stretch, int depth) {
    std::vector<Ability> abilities;
    abilities.reserve(stretch.elements.size());
    for (const Element& e : stretch.elements) abilities.push_back(ability(e));
    const auto changes = lay_out(stretch, used_share * options_.tolerance, abilities, progress_);
    double at = 0;
    std::size_t hint = 0;
    for (const Change& change : changes) {
      if (change.b - change.a < shortest_change) {
        fail(stretch.elements[change.run ? stretch.find(change.a, hint) : change.joint]);
      } else if (!change.run) {
        corner(stretch, change, at, hint);
      } else {
        keep(stretch, at, change.a, hint);
        at = smooth(stretch, change, depth, hint) ? change.b : change.a;
      }
    }
    keep(stretch, at, stretch.length(), hint);
  }

  void append(const std::shared_ptr<const Curve>& curve, const Element& from) {
    const std::size_t before = result_.path.size();
    try {
      result_.path.append(curve, from.source);
    } catch (const InvalidInput&) {
      return;  // the curve has no length
    }
    owner_.insert(owner_.end(), result_.path.size() - before, from.block);
  }

  /// A piece of a given segment remains one segment.
  void keep(const std::shared_ptr<const Curve>& piece, const Element& from) {
    try {
      result_.path.append_piece(piece, from.source);
    } catch (const InvalidInput&) {
      return;  // the piece has no length
    }
    owner_.push_back(from.block);
  }

  /// Copies the part between a and b unchanged.
  void keep(const ElementRun& stretch, double a, double b, std::size_t& hint) {
    if (!(b > a)) return;
    for (std::size_t i = hint = stretch.find(a, hint); i < stretch.elements.size(); ++i) {
      const Element& e = stretch.elements[i];
      if (e.begin >= b) break;
      hint = i;
      const double low = std::max(0.0, a - e.begin), high = std::min(e.length, b - e.begin);
      if (high - low > shortest_rest || (low <= 0 && high >= e.length)) keep(e.part(low, high), e);
      tick();
    }
  }

  void tick() {
    if (++done_ % progress_step == 0) report();
  }

  /// Copies the part between `at` and the blend, and moves `at` behind it. Changes nothing if the joint cannot be
  /// blended within the tolerance.
  void corner(const ElementRun& stretch, const Change& change, double& at, std::size_t& hint) {
    tick();
    const Element &before = stretch.elements[change.joint - 1], &after = stretch.elements[change.joint];
    double d1 = after.begin - change.a, d2 = change.b - after.begin;
    const double tolerance = used_share * options_.tolerance;
    for (int attempt = 0; attempt < max_attempts && d1 + d2 >= shortest_change; ++attempt) {
      const Rational curve = corner_curve(before, d1, after, d2);
      const CornerFit fit = corner_fit(curve, before, d1, after, d2, fitted_share * options_.tolerance);
      if (fit.deviation <= fitted_share * options_.tolerance) {
        keep(stretch, at, after.begin - d1, hint);
        at = after.begin + d2;
        if (before.block == after.block) {
          append(std::make_shared<Rational>(curve), before);
        } else {
          append(std::make_shared<Rational>(curve.restricted(0, fit.joint, 0.5 * fit.joint)), before);
          append(std::make_shared<Rational>(curve.restricted(fit.joint, 1, 0.5 * (fit.joint + 1))), after);
        }
        ++count_.corners;
        return;
      }
      const double factor = std::clamp(std::sqrt(0.95 * tolerance / fit.deviation), 0.3, 0.97 - 0.04 * attempt);
      d1 *= factor;
      d2 *= factor;
    }
    fail(after);
  }

  void fail(const Element& after) {
    if (count_.failed++ == 0) count_.first_failed = after.at(0).value;
  }

  bool smooth(const ElementRun& stretch, const Change& change, int depth, std::size_t hint) {
    const double length = stretch.length(), near = 1e-9 * length;
    RunRange range{change.a, change.b, true, true};
    if (range.a <= near) range.a = 0, range.clamped_begin = !stretch.rest_begin;
    if (range.b >= length - near) range.b = length, range.clamped_end = !stretch.rest_end;
    std::vector<double> borders;
    std::size_t segments = 1;
    for (std::size_t i = stretch.find(range.a, hint) + 1;
         i < stretch.elements.size() && stretch.elements[i].begin < range.b; ++i, ++segments)
      if (stretch.elements[i].block != stretch.elements[i - 1].block) borders.push_back(stretch.elements[i].begin);
    const auto smoothed = [&](bool rests) {
      const RunTolerance tolerance{used_share * options_.tolerance, fitted_share * options_.tolerance};
      return smooth_run(stretch, range, borders, {tolerance, given_.dimension, rests}, progress_);
    };
    SmoothedRun run = smoothed(depth >= max_splits);
    if (!run.done && depth < max_splits) {
      const auto cuts = sharpest_joints(stretch, range.a, range.b, run.failure_positions, hint);
      if (!cuts.empty()) return split(stretch, range, cuts, depth, hint), true;
      run = smoothed(true);
    }
    if (!run.done) {
      if (count_.unsmoothed++ == 0) count_.first_unsmoothed = stretch.elements[stretch.find(range.a, hint)].at(0).value;
      return false;
    }
    bool left = false;
    for (std::size_t k = 0; k < run.pieces.size(); ++k) {
      hint = stretch.find(0.5 * (run.breaks[k] + run.breaks[k + 1]), hint);
      if (run.pieces[k]) {
        append(std::make_shared<Rational>(std::move(*run.pieces[k])), stretch.elements[hint]);
        continue;
      }
      if (!left && count_.unsmoothed++ == 0) count_.first_unsmoothed = stretch.elements[hint].at(0).value;
      left = true;
      hint = stretch.find(run.breaks[k], 0);
      keep(stretch, run.breaks[k], run.breaks[k + 1], hint);
    }
    done_ += segments;
    ++count_.runs;
    count_.run_segments += segments;
    return true;
  }

  /// Divides a run that cannot be smoothed as a whole: the sharpest joints next to the failure become rests, and the
  /// parts between them are laid out again.
  void split(const ElementRun& stretch, const RunRange& range, std::vector<std::size_t> cuts, int depth,
             std::size_t hint) {
    std::size_t i = stretch.find(range.a, hint);
    cuts.push_back(stretch.elements.size());
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      ElementRun part;
      part.rest_begin = k > 0 || !range.clamped_begin;
      part.rest_end = k + 1 < cuts.size() || !range.clamped_end;
      for (; i < cuts[k] && stretch.elements[i].begin < range.b; ++i) {
        const Element& whole = stretch.elements[i];
        const double low = std::max(0.0, range.a - whole.begin), high = std::min(whole.length, range.b - whole.begin);
        if (!(high > low)) continue;
        part.elements.push_back(cut(whole, low, high, part.length()));
      }
      if (!part.elements.empty()) process(part, depth + 1);
    }
  }

  /// Part of an element as an element of its own.
  Element cut(const Element& whole, double low, double high, double begin) {
    Element e = whole;
    e.begin = begin;
    if (low <= 0 && high >= whole.length) return e;
    if (e.straight) {
      e.from = whole.from + low * whole.tangent;
      e.length = high - low;
      e.segment = nullptr;
      return e;
    }
    parts_.push_back(std::make_unique<Segment>(Segment::piece(whole.part(low, high), 0.0, whole.source)));
    e.segment = parts_.back().get();
    e.length = e.segment->length();
    return e;
  }

  void finish_blocks() {
    std::size_t i = 0;
    for (std::size_t b = 0; b < result_.blocks.size(); ++b) {
      result_.blocks[b].first = i;
      while (i < owner_.size() && owner_[i] <= b) ++i;
      result_.blocks[b].last = i;
      if (result_.blocks[b].first == i && given_.blocks[b].first < given_.blocks[b].last)
        throw ToleranceUnreachable(
            "block " + std::to_string(b) + " is too short to keep a place on the rounded contour",
            given_.path[given_.blocks[b].first].length());
    }
  }

  const Contour& given_;
  const BlendOptions& options_;
  const ToolLimitsMap& limits_;
  ProgressScope progress_;
  std::vector<std::size_t> block_, owner_;
  std::vector<bool> rest_;
  std::vector<std::unique_ptr<Segment>> parts_;
  Contour result_;
  BlendCount count_;
  std::size_t done_ = 0;
  std::vector<BlendSection>* sections_;
  std::size_t changes_ = 0;  // number of changes before the current section
};

}  // namespace

Contour blend(const Contour& given, const BlendOptions& options, const ToolLimitsMap& limits, Progress progress,
              std::vector<BlendSection>* sections) {
  if (!(options.tolerance >= min_tolerance && options.tolerance <= max_tolerance))
    throw InvalidInput({{{"planning", "corner", "tolerance"}, "the tolerance has to be 1e-5 to 1e3 mm"}});
  return Blender(given, options, limits, progress, sections).run();
}

}  // namespace bahnwerk
