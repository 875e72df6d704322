#include "core/plan/slow_lines.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress_scope.hpp"
#include "core/motion/law/path_motion.hpp"

namespace bahnwerk {
namespace {

constexpr double binds = 0.95;  // part of a limit from which on it binds

struct Line {
  std::size_t source = 0;
  double time = 0;
};

/// Returns all limits in a fixed order: feed, the axes' velocity, acceleration and jerk, the path's acceleration and
/// jerk, a dwell.
class Reasons {
 public:
  Reasons(const Machine& machine, const Limits& along) : machine_(machine), along_(along) {
    names_.push_back("feed");
    for (const char* what : {"velocity ", "acceleration ", "jerk "})
      for (const AxisLimits& axis : machine.axes) names_.push_back(what + axis.name);
    names_.insert(names_.end(), {"path acceleration", "path jerk", "dwell"});
  }

  std::size_t count() const { return names_.size(); }
  const std::string& name(std::size_t i) const { return names_[i]; }
  std::size_t dwell() const { return names_.size() - 1; }

  /// Returns the limit that is closest to being active; count() if none is.
  std::size_t at(const MotionState& x, const LawState& law, double feed) const {
    std::size_t best = count(), i = 0;
    double most = binds;
    const auto offer = [&](double value, double limit) {
      if (const double part = std::abs(value) / limit; part >= most) best = i, most = part;
      ++i;
    };
    const std::size_t axes = machine_.axes.size();
    offer(law.v, std::min(feed, along_.velocity));
    for (std::size_t k = 0; k < axes; ++k) offer(x[1][k], machine_.axes[k].velocity);
    for (std::size_t k = 0; k < axes; ++k) offer(x[2][k], machine_.axes[k].acceleration);
    for (std::size_t k = 0; k < axes; ++k) offer(x[3][k], machine_.axes[k].jerk);
    offer(law.a, along_.acceleration);
    offer(law.j, along_.jerk);
    return best;
  }

 private:
  const Machine& machine_;
  Limits along_;
  std::vector<std::string> names_;
};

}  // namespace

std::vector<SlowLine> slow_lines(const PathMotion& motion, const Machine& machine, const std::vector<double>& feeds,
                                 const Limits& along, std::size_t count, Progress progress) {
  ProgressScope stage_progress(progress, "report");
  const AxisPath& path = motion.path();
  const auto& pieces = motion.law().pieces();
  std::size_t sources = 0;
  for (std::size_t i = 0; i < path.size(); ++i) sources = std::max(sources, path[i].source() + 1);
  std::vector<Line> lines(sources);
  for (const LawPiece& p : pieces) {
    lines[path[p.segment].source()].time += p.duration;
    stage_progress.work(1);
  }
  for (std::size_t i = 0; i < sources; ++i) lines[i].source = i;
  count = std::min(count, sources);
  std::partial_sort(
      lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(count), lines.end(),
      [](const Line& a, const Line& b) { return a.time != b.time ? a.time > b.time : a.source < b.source; });
  lines.resize(count);
  while (!lines.empty() && !(lines.back().time > 0)) lines.pop_back();

  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> row(sources, none);
  for (std::size_t i = 0; i < lines.size(); ++i) row[lines[i].source] = i;
  const Reasons reasons(machine, along);
  std::vector<SlowLine> report(lines.size());
  std::vector<std::vector<double>> times(lines.size(), std::vector<double>(reasons.count() + 1, 0));
  for (std::size_t i = 0; i < path.size(); ++i)
    if (const std::size_t r = row[path[i].source()]; r != none) {
      report[r].length += path[i].length();
      report[r].feed = std::max(report[r].feed, feeds[i]);
    }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const LawPiece& p = pieces[i];
    const std::size_t r = row[path[p.segment].source()];
    stage_progress.work(1);
    if (r == none) continue;
    stage_progress.work(8);
    const bool dwell = p.v == 0 && p.a == 0 && p.j == 0 && !(p.s_end > p.s);
    const LawState end = p.at(p.duration);
    report[r].stops = report[r].stops || dwell || !(p.v > 0) || !(end.v > 1e-9 * std::max(1.0, p.v));
    std::size_t reason = reasons.dwell();
    if (!dwell) {
      const LawState middle = motion.along(i, p.t0 + 0.5 * p.duration);
      reason = reasons.at(motion.driven(i, middle), middle, feeds[p.segment]);
    }
    times[r][reason] += p.duration;
  }
  for (std::size_t r = 0; r < lines.size(); ++r) {
    report[r].source = lines[r].source;
    report[r].time = lines[r].time;
    report[r].share = std::min(1.0, lines[r].time / motion.duration());
    const auto most = std::max_element(times[r].begin(), times[r].end());
    const auto reason = static_cast<std::size_t>(most - times[r].begin());
    if (reason < reasons.count()) report[r].limit = reasons.name(reason);
    report[r].limit_share = std::min(1.0, *most / lines[r].time);
  }
  return report;
}

}  // namespace bahnwerk
