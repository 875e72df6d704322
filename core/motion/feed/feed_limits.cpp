#include "core/motion/feed/feed_limits.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/golden_section.hpp"

namespace bahnwerk {
namespace {

constexpr double flat = 1e-8;        // neighbours that differ by less have nothing between them that counts
constexpr double exact = 1 + 1e-12;  // factor for the rounding of a limit that is reached

double ratio(double limit, double rate) { return std::abs(rate) > 0 ? limit / std::abs(rate) : unlimited; }

/// Returns the largest f in [0, 1] up to which |c0 + c1 f + c2 f²| ≤ most; 0 if there is none.
double first_exit(double c0, double c1, double c2, double most) {
  if (!(std::abs(c0) <= most)) return 0;
  double least = 1;
  for (const double border : {most, -most}) {
    const double c = c0 - border, square = c1 * c1 - 4 * c2 * c;
    if (!(square >= 0)) continue;
    const double sum = -(c1 + std::copysign(std::sqrt(square), c1));  // the sum without cancellation
    for (const double f : {sum / (2 * c2), 2 * c / sum})
      if (f >= 0 && f < least) least = f;
  }
  return least;
}

}  // namespace

std::string in_words(const FeedLimit& limit, const Machine& machine) {
  using Kind = FeedLimit::Kind;
  const auto of = [&](const char* what) { return std::string(what) + " of " + machine.axes.at(limit.axis).name; };
  switch (limit.kind) {
    case Kind::velocity:
      return of("the velocity limit");
    case Kind::acceleration:
      return of("the acceleration limit");
    case Kind::jerk:
      return of("the jerk limit");
    case Kind::velocity_step:
      return "at a joint of the path " + of("the acceleration limit");
    case Kind::acceleration_step:
      return "at a joint of the path " + of("the jerk limit");
    case Kind::path_velocity:
      return "the limit on the speed along the path";
    case Kind::segment_feed:
      break;
  }
  return "the feed of the path's piece";
}

FeedGrid::FeedGrid(const PathTask& task, const FeedGridOptions& options, ProgressScope& progress)
    : task_(task), options_(options), axes_(task.path.axes()) {
  sections_ = find_sections(task, options.corner_angle, progress);
  for (std::size_t i = 0; i < task.path.size(); ++i) {
    first_.push_back(s_.size());
    sample(i);
    progress.work(4 * (s_.size() - first_.back()));
    progress.done(static_cast<double>(i) / static_cast<double>(task.path.size()));
  }
  first_.push_back(s_.size());
  for (std::size_t i = 0; i < task.path.size(); ++i) {
    search(i);
    progress.work(200);
  }
  joint_.assign(task.path.size(), unlimited);
  for (std::size_t i = 1; i < task.path.size(); ++i) limit_at_joint(i);
}

void FeedGrid::sample(std::size_t i) {
  const Segment& segment = task_.path[i];
  const std::vector<double> panels = segment.panel_parameters();
  std::vector<double> places;
  const std::size_t n = options_.nodes;
  for (std::size_t p = 0; p + 1 < panels.size(); ++p)
    for (std::size_t k = 0; k < n; ++k)
      places.push_back(panels[p] + (panels[p + 1] - panels[p]) * static_cast<double>(k) / static_cast<double>(n));
  places.push_back(panels.back());
  PathBatch batch;
  for (std::size_t from = 0; from < places.size(); from += PathBatch::most) {
    batch.count = std::min(PathBatch::most, places.size() - from);
    batch.planar = true;
    for (std::size_t k = 0; k < batch.count; ++k) batch.u.set(k, places[from + k]);
    task_.path.at_parameters(i, batch);
    for (std::size_t k = 0; k < batch.count; ++k) {
      u_.push_back(places[from + k]);
      s_.push_back(segment.s0() + batch.s[k]);
      for (const auto* rows : {&batch.d1, &batch.d2, &batch.d3})
        for (std::size_t axis = 0; axis < axes_; ++axis)
          rows_.push_back(batch.planar && axis >= 2 ? 0 : (*rows)[axis][k]);
    }
  }
  s_.back() = segment.s1();
  s_[first_.back()] = segment.s0();
}

FeedLimit FeedGrid::limit_of(const double* d1, const double* d2, const double* d3) const {
  FeedLimit least;
  const auto offer = [&](double speed, FeedLimit::Kind kind, std::size_t axis) {
    if (speed < least.speed) least.speed = speed, least.kind = kind, least.axis = axis;
  };
  for (std::size_t k = 0; k < axes_; ++k) {
    const AxisLimits& axis = task_.machine.axes[k];
    offer(ratio(axis.velocity, d1[k]), FeedLimit::Kind::velocity, k);
    offer(std::sqrt(ratio(axis.acceleration, d2[k])), FeedLimit::Kind::acceleration, k);
    if (options_.order == 3) offer(std::cbrt(ratio(axis.jerk, d3[k])), FeedLimit::Kind::jerk, k);
  }
  return least;
}

FeedLimit FeedGrid::at(std::size_t segment, double u) const {
  const AxisJet q = task_.path.at_parameter(segment, u);
  return limit_of(q.d1.data(), q.d2.data(), q.d3.data());
}

FeedLimit FeedGrid::slowest_around(std::size_t segment, double low, double high) const {
  struct Slow {
    FeedLimit limit;
    bool operator<(const Slow& other) const {
      return !(limit.speed < other.limit.speed);
    }  // among equals the later one
  };
  const auto slow = [&](double u) { return Slow{at(segment, u)}; };
  const auto slowest = golden_section(slow, low, high, 1e-5 * (high - low));
  FeedLimit found = slowest.value.limit;
  found.s = task_.path[segment].arc_length(slowest.at);
  found.segment = segment;
  return found;
}

void FeedGrid::search(std::size_t i) {
  FeedLimit least;
  for (std::size_t n = first(i); n < last(i); ++n) {
    const FeedNode here = node(n);
    FeedLimit limit = limit_of(here.d1, here.d2, here.d3);
    limit.s = here.s;
    speed_.push_back(limit.speed);
    if (limit.speed < least.speed) least = limit;
  }
  for (std::size_t n = first(i); n < last(i); ++n) {
    const std::size_t before = n > first(i) ? n - 1 : n, after = n + 1 < last(i) ? n + 1 : n;
    if (speed_[before] < speed_[n] || speed_[after] < speed_[n] ||
        std::max(speed_[before], speed_[after]) <= speed_[n] * (1 + flat))
      continue;
    minima_.push_back(slowest_around(i, u_[before], u_[after]));
    if (minima_.back().speed < least.speed) least = minima_.back();
  }
  least.speed /= exact;
  const double s0 = task_.path[i].s0();
  if (task_.feeds[i] < least.speed) least = {task_.feeds[i], FeedLimit::Kind::segment_feed, 0, s0, i};
  if (options_.along.velocity < least.speed)
    least = {options_.along.velocity, FeedLimit::Kind::path_velocity, 0, s0, i};
  least.segment = i;
  hold_.push_back(least);
}

double FeedGrid::hold_between(std::size_t i, double s0, double s1, double share) const {
  const Segment& segment = task_.path[i];
  double least = std::min(at(i, segment.parameter(s0)).speed, at(i, segment.parameter(s1)).speed);
  for (std::size_t n = first(i); n < last(i); ++n)
    if (s_[n] >= s0 && s_[n] <= s1) least = std::min(least, speed_[n]);
  const auto from = std::lower_bound(minima_.begin(), minima_.end(), s0,
                                     [](const FeedLimit& limit, double s) { return limit.s < s; });
  for (auto found = from; found != minima_.end() && found->s <= s1; ++found)
    if (found->segment == i) least = std::min(least, found->speed);
  if (!(s0 > segment.s0())) least = std::min(least, joint_[i]);
  if (!(s1 < segment.s1()) && i + 1 < task_.path.size()) least = std::min(least, joint_[i + 1]);
  return std::min({share * least / exact, task_.feeds[i], options_.along.velocity});
}

void FeedGrid::limit_at_joint(std::size_t next) {
  if (std::binary_search(sections_.begin.begin(), sections_.begin.end(), next)) return;  // the motion is at rest there
  FeedLimit least;
  least.s = task_.path[next].s0();
  const FeedNode before = node(last(next - 1) - 1), after = node(first(next));
  for (std::size_t k = 0; k < axes_; ++k) {
    const AxisLimits& axis = task_.machine.axes[k];
    const double T = task_.machine.cycle_time;
    const double step = ratio(axis.acceleration * T, after.d1[k] - before.d1[k]);
    if (step < least.speed) least.speed = step, least.kind = FeedLimit::Kind::velocity_step, least.axis = k;
    if (options_.order < 3) continue;
    const double jump = std::sqrt(ratio(axis.jerk * T, after.d2[k] - before.d2[k]));
    if (jump < least.speed) least.speed = jump, least.kind = FeedLimit::Kind::acceleration_step, least.axis = k;
  }
  joint_[next] = least.speed;
  least.speed /= exact;
  for (const std::size_t i : {next - 1, next})
    if (least.speed < hold_[i].speed) hold_[i] = least, hold_[i].segment = i;
}

double FeedGrid::acceleration(std::size_t i) const {
  double least = options_.along.acceleration;
  for (std::size_t k = 0; k < axes_; ++k)
    least = std::min(least, ratio(task_.machine.axes[k].acceleration, node(i).d1[k]));
  return least;
}

double FeedGrid::jerk(std::size_t i) const {
  if (options_.order < 3) return unlimited;
  double least = options_.along.jerk;
  for (std::size_t k = 0; k < axes_; ++k) least = std::min(least, ratio(task_.machine.axes[k].jerk, node(i).d1[k]));
  return least;
}

double FeedGrid::share(const FeedNode& node, const FeedState& x, double margin) const {
  bool kept = true;
  for (std::size_t k = 0; k < axes_; ++k) {
    const AxisLimits& axis = task_.machine.axes[k];
    const double d1 = node.d1[k], d2 = node.d2[k], d3 = node.d3[k];
    if (std::abs(d1) * x.v > axis.velocity) return 0;
    kept = kept && std::abs(d2 * x.v * x.v + d1 * x.a) <= margin * axis.acceleration;
    if (options_.order == 3)
      kept = kept && std::abs((d3 * x.v * x.v + 3 * d2 * x.a) * x.v + d1 * x.j) <= margin * axis.jerk;
  }
  if (kept) return 1;
  double least = 1;
  for (std::size_t k = 0; k < axes_; ++k) {
    const AxisLimits& axis = task_.machine.axes[k];
    const double d1 = node.d1[k], d2 = node.d2[k], d3 = node.d3[k];
    least = std::min(least, first_exit(d2 * x.v * x.v, d1 * x.a, 0, margin * axis.acceleration));
    if (options_.order == 3)
      least = std::min(least, first_exit(d3 * x.v * x.v * x.v, 3 * d2 * x.v * x.a, d1 * x.j, margin * axis.jerk));
  }
  return least;
}

bool FeedGrid::passes_joint(std::size_t next, const FeedState& x) const {
  const FeedNode before = node(last(next - 1) - 1), after = node(first(next));
  const double T = task_.machine.cycle_time;
  for (std::size_t k = 0; k < axes_; ++k) {
    const AxisLimits& axis = task_.machine.axes[k];
    const double turn = after.d1[k] - before.d1[k];
    if (std::abs(turn) * x.v > axis.acceleration * T) return false;
    if (options_.order == 3 && std::abs((after.d2[k] - before.d2[k]) * x.v * x.v + turn * x.a) > axis.jerk * T)
      return false;
  }
  return true;
}

}  // namespace bahnwerk
