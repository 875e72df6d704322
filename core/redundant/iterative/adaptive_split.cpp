#include "core/redundant/iterative/adaptive_split.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/redundant/coarse/coarse_task.hpp"

namespace bahnwerk {
namespace {

constexpr double acceleration_change =
    5e-2;  // largest change of the acceleration in a cell of the exact check, relative to the fine one's limit
constexpr double stroke_share = 1 - 1e-9;  // share of the stroke that the fit may use, because of rounding
constexpr double rounding = 1e-9;          // relative excess of limits that counts as rounding

constexpr double least_tolerance = 0.1;  // least share of the stroke that thinning has to leave

/// Refuses a distance of samples at which a fine axis may leave its stroke unnoticed.
[[noreturn]] void too_far_apart(const std::string& axis, double spacing) {
  char text[160];
  std::snprintf(text, sizeof text,
                "between samples %.3g ms apart the fine axis %s may leave its stroke; give a smaller number",
                1e3 * spacing, axis.c_str());
  throw InvalidInput({{{"machine", "redundancy", "thinning"}, text}});
}

/// [Bock 4.3.2]: ideally the coarse axes stand still, so the head gets the fine axes' limits; velocities are sums of
/// both axes', and feeds keep them.
Machine first_limits(const CoarseFineMachine& machine) {
  Machine head = summed(machine);
  for (std::size_t k = 0; k < head.axes.size(); ++k) {
    head.axes[k].acceleration = machine.axes[k].fine.acceleration;
    head.axes[k].jerk = machine.axes[k].fine.jerk;
  }
  return head;
}

std::vector<double> first_feeds(const RedundancyTask& task) {
  std::vector<double> feeds = task.feeds;
  for (std::size_t i = 0; i < feeds.size(); ++i) feeds[i] = first_feed(*task.path, i, feeds[i], task.machine);
  return feeds;
}

/// Head and coarse motion with the assessment of a pass.
void slow(SplitPart& part, RedundancyIteration& pass, double factor) {
  part.law.slow(factor);
  for (TimeSpline& axis : part.coarse) axis.slow(factor);
  pass.duration *= factor;
  pass.violated_blocks = 0;
  for (RedundancyPeaks& p : pass.peaks) {
    p.coarse_velocity /= factor, p.fine_velocity /= factor;
    p.coarse_acceleration /= factor * factor, p.fine_acceleration /= factor * factor;
  }
}

}  // namespace

AdaptiveSplit::AdaptiveSplit(const RedundancyTask& task, const RedundancyOptions& options,
                             const IterativeOptions& constants, Progress progress)
    : task_(task),
      options_(options),
      constants_(constants),
      scope_(progress.part(0.2, 1), "planning"),
      order_(task.machine.limited_order()),
      may_keep_(order_ == 2 && options.approximation == CoarseApproximation::least_squares &&
                options.smoothing == CoarseSmoothing::none),
      machine_(first_limits(task.machine)),
      first_feeds_(first_feeds(task)),
      sections_(task, options, machine_, first_feeds_, progress.part(0, 0.1)),
      alone_(task, options, coarse_machine(task.machine, 1), task.feeds, progress.part(0.1, 0.2), sections_.width()) {
  const double spacing = task.machine.cycle_time * options.thinning;
  for (std::size_t k = 0; k < axes(); ++k) {
    if (!(tolerance(k, spacing, machine_.axes[k].velocity) > least_tolerance * task.machine.axes[k].stroke)) {
      if (options.thinning > 1) too_far_apart(task.machine.axes[k].name, spacing);
      resolves_samples_ = false;  // samples of every cycle are the densest possible
    }
    limits_.acceleration.emplace_back(task.path->size(), machine_.axes[k].acceleration);
    limits_.jerk.emplace_back(task.path->size(), machine_.axes[k].jerk);
  }
  limits_.feeds = first_feeds_;
  touched_.assign(sections_.size(), 0);
  fastest_ = sections_.duration(0, sections_.size());
}

std::vector<SlowedSegment> AdaptiveSplit::slowed() const {
  std::vector<SlowedSegment> slowed;
  for (std::size_t i = 0; i < first_feeds_.size(); ++i) {
    bool fell = limits_.feeds[i] < first_feeds_[i];
    const double feed = fell ? limits_.feeds[i] : unlimited;
    for (std::size_t k = 0; k < axes(); ++k)
      fell = fell || limits_.acceleration[k][i] < machine_.axes[k].acceleration ||
             limits_.jerk[k][i] < machine_.axes[k].jerk;
    if (fell) slowed.push_back({i, feed});
  }
  return slowed;
}

Machine AdaptiveSplit::limits_of(std::size_t section) const {
  Machine m = machine_;
  for (std::size_t k = 0; k < axes(); ++k)
    for (std::size_t i = sections_.begin(section); i < sections_.begin(section + 1); ++i) {
      m.axes[k].acceleration = std::min(m.axes[k].acceleration, limits_.acceleration[k][i]);
      m.axes[k].jerk = std::min(m.axes[k].jerk, limits_.jerk[k][i]);
    }
  return m;
}

void AdaptiveSplit::reset(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    if (!touched_[i]) continue;
    for (std::size_t b = sections_.begin(i); b < sections_.begin(i + 1); ++b) {
      limits_.feeds[b] = first_feeds_[b];
      for (std::size_t k = 0; k < axes(); ++k) {
        limits_.acceleration[k][b] = machine_.axes[k].acceleration;
        limits_.jerk[k][b] = machine_.axes[k].jerk;
      }
    }
    replan(i);
    touched_[i] = 0;
  }
}

HeadSamples AdaptiveSplit::sample(const PathMotion& head) const {
  const double duration = head.duration();
  const auto thinning = static_cast<std::size_t>(options_.thinning);
  const double spacing = task_.machine.cycle_time * static_cast<double>(thinning);
  const std::size_t least = 4 * max_spline_degree;  // short motions need some knots, too
  const std::size_t fitted = std::max(static_cast<std::size_t>(std::ceil(duration / spacing)), least);
  HeadSamples s;
  const std::size_t n = fitted * thinning;
  s.times.reserve(n + 1);
  s.segments.reserve(n + 1);
  s.axes.assign(axes(), {});
  for (auto& axis : s.axes) axis.reserve(n + 1);
  std::size_t piece = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    const double t = duration * (static_cast<double>(i) / static_cast<double>(n));
    piece = head.law().find(t, piece);
    const MotionState x = head.in_piece(piece, t);
    s.times.push_back(t);
    s.segments.push_back(head.law().pieces()[piece].segment);
    for (std::size_t k = 0; k < axes(); ++k) s.axes[k].push_back({x[0][k], x[1][k], x[2][k], x[3][k]});
  }
  return s;
}

double AdaptiveSplit::tolerance(std::size_t axis, double spacing, double speed) const {
  const CoarseFineAxis& a = task_.machine.axes[axis];
  // [Bock 4.3.5]: half of the distance that both axes can travel between samples; for close samples the fine
  // acceleration gives a sharper value.
  const double by_velocity = 0.5 * (a.coarse.velocity + speed) * spacing;
  const double by_acceleration = a.fine.acceleration * spacing * spacing / 8;
  const double cell = task_.machine.cycle_time, of_check = a.fine.acceleration * cell * cell / 8;
  return a.stroke * stroke_share - std::min(by_velocity, by_acceleration) - of_check;
}

bool AdaptiveSplit::fit(const HeadSamples& head, const std::vector<SplineBegin>& begin, int iteration, bool ends,
                        std::vector<TimeSpline>& coarse) {
  CoarseFitOptions o;
  o.approximation = options_.approximation;
  o.smoothing = options_.smoothing;
  o.degree = static_cast<std::size_t>(options_.degree);
  o.multiplicity = static_cast<std::size_t>(options_.knot_multiplicity);
  o.afterburner = static_cast<std::size_t>(options_.afterburner);
  o.afterburner_evenly = options_.window.has_value();
  o.sampled_limits = constants_.sampled_limits;
  o.wide = constants_.wide_gap;
  if (may_keep_) o.grading = constants_.grading;
  o.tick = [this] { scope_.report(); };
  const auto thinning = static_cast<std::size_t>(options_.thinning);
  const double spacing = head.times[thinning] - head.times[0];
  coarse.clear();
  for (std::size_t k = 0; k < axes(); ++k) {
    CoarseTask task;
    task.duration = head.times.back();
    task.positions.reserve(head.times.size() / thinning + 1);
    for (std::size_t i = 0; i < head.times.size(); i += thinning) task.positions.push_back(head.axes[k][i].x);
    for (const AxisState& x : head.axes[k]) task.speed = std::max(task.speed, std::abs(x.v));
    task.tolerance = tolerance(k, spacing, task.speed);
    task.begin = begin[k];
    if (kept(iteration) > 0) task.knots = knots_.times(head, k);
    task.limits = task_.machine.axes[k].coarse;
    if (ends && task_.machine.axes[k].centred) task.begin.end = task.positions.back();
    std::optional<CoarseFit> found = fit_coarse(task, o);
    if (!found) return false;
    coarse.push_back(std::move(found->spline));
  }
  if (may_keep_) knots_.keep(head, coarse);
  return true;
}

void AdaptiveSplit::replan(std::size_t section) { sections_.replan(section, limits_of(section), limits_.feeds); }

HeadCells AdaptiveSplit::cells_of(const TimeLaw& law) {
  HeadCellOptions o;
  o.longest = task_.machine.cycle_time;
  for (std::size_t k = 0; k < axes(); ++k) {
    o.held.push_back(machine_.axes[k]);
    o.acceleration_change.push_back(acceleration_change * task_.machine.axes[k].fine.acceleration);
    o.jerk_change.push_back(unlimited);
    o.jerk_range.push_back(unlimited);
  }
  const PathMotion head(task_.path, law);
  HeadCells cells = head_cells(head, o, scope_);
  const MotionState end =
      head.in_piece(head.pieces() - 1, head.duration());  // the end of these sections, not of the path
  for (std::size_t k = 0; k < axes(); ++k) cells.nodes[k].back() = {end[0][k], end[1][k], end[2][k]};
  return cells;
}

std::vector<std::vector<SplitPeaks>> AdaptiveSplit::exact_peaks(const TimeLaw& law,
                                                                const std::vector<TimeSpline>& coarse,
                                                                std::size_t first, std::size_t last) {
  const std::size_t block = sections_.begin(first), end = sections_.begin(last);
  std::vector<std::vector<SplitPeaks>> peaks(axes(), std::vector<SplitPeaks>(end - block));
  const auto& pieces = law.pieces();
  std::vector<CellsBegin> at(axes());
  for (std::size_t i = first, piece = 0; i < last; ++i) {
    const std::size_t from = sections_.begin(i), to = sections_.begin(i + 1);
    TimeLaw section;
    std::size_t next = piece;
    for (; next < pieces.size() && (i + 1 == last || pieces[next].segment < to); ++next) section.append(pieces[next]);
    const HeadCells cells = cells_of(section);
    for (std::size_t k = 0; k < axes(); ++k) {
      at[k].law = piece;
      const std::vector<SplitPeaks> here = split_peaks(cells, law, k, coarse[k], {from, to}, at[k]);
      std::copy(here.begin(), here.end(), peaks[k].begin() + static_cast<std::ptrdiff_t>(from - block));
    }
    piece = next;
  }
  return peaks;
}

AdaptiveSplit::Assessment AdaptiveSplit::assessed(double duration,
                                                  const std::vector<std::vector<SplitPeaks>>& peaks) const {
  Assessment assessment;
  RedundancyIteration& pass = assessment.pass;
  pass.duration = duration;
  pass.peaks.resize(axes());
  for (std::size_t b = 0; b < peaks.front().size(); ++b) {
    bool violated = false;
    for (std::size_t k = 0; k < axes(); ++k) {
      const SplitPeaks& p = peaks[k][b];
      const CoarseFineAxis& a = task_.machine.axes[k];
      RedundancyPeaks& worst = pass.peaks[k];
      // `order` of the derivative: a slowing by a factor divides it by that power.
      const auto look = [&](double value, double limit, int order, double& most) {
        most = std::max(most, value);
        if (!(value > limit * (1 + rounding))) return;
        violated = true;
        assessment.slowing =
            std::max(assessment.slowing, order == 0 ? unlimited : std::pow(value / limit, 1.0 / order));
      };
      double coarse_jerk = 0, fine_jerk = 0;
      look(p.offset, a.stroke, 0, worst.offset);
      look(p.coarse_velocity, a.coarse.velocity, 1, worst.coarse_velocity);
      look(p.coarse_acceleration, a.coarse.acceleration, 2, worst.coarse_acceleration);
      look(p.fine_velocity, a.fine.velocity, 1, worst.fine_velocity);
      look(p.fine_acceleration, a.fine.acceleration, 2, worst.fine_acceleration);
      look(p.coarse_jerk, a.coarse.jerk, 3, coarse_jerk);
      look(p.fine_jerk, a.fine.jerk, 3, fine_jerk);
    }
    pass.violated_blocks += violated;
  }
  return assessment;
}

bool AdaptiveSplit::adapt_all(const std::vector<std::vector<SplitPeaks>>& peaks, std::size_t first, std::size_t last,
                              int iteration) {
  const std::size_t begin = sections_.begin(first), blocks = sections_.begin(last) - begin;
  const HeadLimits before = limits_;
  const int impatient = std::max(kept(iteration), order_ == 3 ? 0 : iteration - constants_.patience);
  const AdaptationOptions adaptation =
      impatient > 0 ? with_larger_steps(constants_.adaptation, impatient) : constants_.adaptation;
  bool fell = false;
  std::vector<double> coarse(blocks), fine(blocks);
  for (std::size_t k = 0; k < axes(); ++k) {
    const CoarseFineAxis& a = task_.machine.axes[k];
    const auto of = [&](double SplitPeaks::*coarse_peak, double SplitPeaks::*fine_peak) {
      for (std::size_t b = 0; b < blocks; ++b) coarse[b] = peaks[k][b].*coarse_peak, fine[b] = peaks[k][b].*fine_peak;
    };
    of(&SplitPeaks::coarse_acceleration, &SplitPeaks::fine_acceleration);
    // Within the limit of the fine acceleration the stroke can only be exceeded between samples.
    fell |= adapt(limits_.acceleration[k], begin, {coarse, a.coarse.acceleration}, {fine, a.fine.acceleration},
                  iteration, adaptation);
    if (order_ == 2) continue;
    of(&SplitPeaks::coarse_jerk, &SplitPeaks::fine_jerk);
    fell |= adapt(limits_.jerk[k], begin, {coarse, a.coarse.jerk}, {fine, a.fine.jerk}, iteration, adaptation);
  }
  for (std::size_t b = 0; b < blocks; ++b) {
    std::vector<SplitPeaks> here;
    for (std::size_t k = 0; k < axes(); ++k) here.push_back(peaks[k][b]);
    fell |= adapt_feed(limits_.feeds[begin + b], first_feeds_[begin + b], here, task_.machine, adaptation);
  }
  for (std::size_t i = first; i < last; ++i) {
    bool changed = false;
    for (std::size_t b = sections_.begin(i); b < sections_.begin(i + 1); ++b) {
      changed = changed || limits_.feeds[b] < before.feeds[b];
      for (std::size_t k = 0; k < axes(); ++k)
        changed =
            changed || limits_.acceleration[k][b] < before.acceleration[k][b] || limits_.jerk[k][b] < before.jerk[k][b];
    }
    if (!changed) continue;
    replan(i);
    touched_[i] = 1;
  }
  return fell;
}

std::optional<SplitPart> AdaptiveSplit::solve(std::size_t first, std::size_t last,
                                              const std::vector<SplineBegin>& begin) {
  reset(first, last);
  const std::size_t block = sections_.begin(first), end = sections_.begin(last);
  const double longest = alone_.duration(first, last);
  const bool rests = std::all_of(begin.begin(), begin.end(),
                                 [](const SplineBegin& at) { return at.velocity == 0 && at.acceleration == 0; });
  const double bearable = rests ? 1 + constants_.most_slowing : 1;
  std::optional<SplitPart> best;  // best pass so far, before slowing
  double best_slowing = unlimited;
  const auto takes = [&] { return best ? best->law.duration() * best_slowing : unlimited; };
  // Slow the motion by the factor of its excess between samples; none if that does not help.
  const auto slowed = [&](SplitPart part) -> std::optional<SplitPart> {
    Assessment found = assessed(part.law.duration(), exact_peaks(part.law, part.coarse, first, last));
    if (!(found.slowing < unlimited) || !(found.slowing * part.law.duration() <= longest)) return std::nullopt;
    if (found.slowing > 1) slow(part, found.pass, found.slowing);
    passes_.push_back(found.pass);
    return part;
  };
  for (int iteration = 1; iteration <= constants_.max_iterations; ++iteration) {
    scope_.half_of_rest();
    SplitPart part{first, last, sections_.law(first, last), {}};
    // Limits only fall, so later passes take at least as long as the head alone does now.
    if (part.law.duration() > longest || part.law.duration() * (1 + constants_.most_slowing) >= takes()) break;
    const PathMotion head(task_.path, part.law);
    const HeadSamples samples = sample(head);
    if (!fit(samples, begin, iteration, last == sections_.size(), part.coarse)) break;
    std::vector<std::vector<SplitPeaks>> peaks;
    for (std::size_t k = 0; k < axes(); ++k) peaks.push_back(sampled_peaks(samples, k, part.coarse[k], {block, end}));
    Assessment found = assessed(head.duration(), peaks);
    if (found.slowing <= bearable) {  // at samples: look between them
      peaks = exact_peaks(part.law, part.coarse, first, last);
      found = assessed(head.duration(), peaks);
    }
    if (found.slowing <= bearable) {
      if (found.slowing > 1) slow(part, found.pass, found.slowing);
      passes_.push_back(found.pass);
      return part;
    }
    passes_.push_back(found.pass);
    if (rests && found.slowing * head.duration() < std::min(takes(), longest)) {
      best = std::move(part);
      best_slowing = found.slowing;
    }
    // If no limit falls, the anchor has to fall first.
    bool fell = adapt_all(peaks, first, last, iteration);
    while (!fell && ++iteration <= constants_.adaptation.anchor_steps) fell = adapt_all(peaks, first, last, iteration);
    if (!fell) break;
  }
  return best ? slowed(std::move(*best)) : std::nullopt;
}

}  // namespace bahnwerk
