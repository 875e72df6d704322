#include "core/motion/axes/machine_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/number_text.hpp"
#include "core/numeric/sign_change.hpp"

namespace bahnwerk {
namespace {

constexpr int per_panel = 8;
constexpr int most_steps = 40;
constexpr double negligible = 1e-13;  // mm or rad, by which an axis may move further than to the turning point found
constexpr double range_tolerance = 1e-9;  // mm or rad

class Spans {
 public:
  explicit Spans(const AxisPath& path) : path_(path), spans_(path.axes()) {
    for (AxisSpan& span : spans_) span.lowest = unlimited, span.highest = -unlimited;
  }
  std::vector<AxisSpan> found() {
    for (segment_ = 0; segment_ < path_.size(); ++segment_) {
      const std::vector<double> panels = path_[segment_].panel_parameters();
      double u = panels.front();
      AxisJet q = path_.at_parameter(segment_, u);
      for (std::size_t k = 0; k < spans_.size(); ++k) offer(k, u, q.value[k]);
      for (std::size_t i = 1; i < panels.size(); ++i)
        for (int part = 1; part <= per_panel; ++part) {
          const double next =
              part == per_panel ? panels[i] : panels[i - 1] + (panels[i] - panels[i - 1]) * part / per_panel;
          const AxisJet after = path_.at_parameter(segment_, next);
          for (std::size_t k = 0; k < spans_.size(); ++k) go(k, u, q, next, after);
          u = next, q = after;
        }
    }
    return std::move(spans_);
  }

 private:
  void offer(std::size_t k, double u, double value) {
    AxisSpan& span = spans_[k];
    if (value < span.lowest) span.lowest = value, span.lowest_at = path_[segment_].arc_length(u);
    if (value > span.highest) span.highest = value, span.highest_at = path_[segment_].arc_length(u);
  }
  void go(std::size_t k, double u, const AxisJet& q, double next, const AxisJet& after) {
    offer(k, next, after.value[k]);
    double turned = q.value[k];
    if (q.d1[k] * after.d1[k] < 0) {
      SignChange slopes{u, q.d1[k], next, after.d1[k]};
      double at = u;
      for (int i = 0; i < most_steps; ++i) {
        at = std::clamp(slopes.next(), slopes.low, slopes.high);
        const AxisJet there = path_.at_parameter(segment_, at);
        const double slope = there.d1[k];
        turned = there.value[k];
        if (slope * slope <= 2 * negligible * std::abs(there.d2[k])) break;
        slopes.take(at, slope);
      }
      offer(k, at, turned);
    }
    spans_[k].travel += std::abs(turned - q.value[k]) + std::abs(after.value[k] - turned);
  }

  const AxisPath& path_;
  std::vector<AxisSpan> spans_;
  std::size_t segment_ = 0;
};

/// Throws UnreachablePose at the extreme that lies furthest outside.
void hold_ranges(const KinematicAxisPath& path, const std::vector<AxisSpan>& spans) {
  for (std::size_t k = 0; k < spans.size(); ++k) {
    const AxisLimits& axis = path.kinematics().axes()[k];
    const AxisSpan& span = spans[k];
    const double below = axis.lowest - span.lowest, above = span.highest - axis.highest;
    if (!(std::max(below, above) > range_tolerance)) continue;
    const double s = below > above ? span.lowest_at : span.highest_at;
    const std::size_t segment = path.tool().find(s);
    const bool rotary = axis.unit == "rad";
    const double shown = rotary ? 180 / std::numbers::pi : 1;  // documents have deg
    const char* const unit = rotary ? "deg" : axis.unit.c_str();
    const auto apart = [&](double a, double b) { return number_text(shown * a, shown * b, 6); };
    const std::string text = "axis " + axis.name + " would have to go from " + apart(span.lowest, axis.lowest) +
                             " to " + apart(span.highest, axis.highest) + " " + unit + ", its range is " +
                             apart(axis.lowest, span.lowest) + " to " + apart(axis.highest, span.highest) + " " + unit;
    throw UnreachablePose(text, s, path.pose(segment, path[segment].parameter(s)).coordinates());
  }
}

}  // namespace

std::vector<AxisSpan> axis_spans(const AxisPath& path) { return Spans(path).found(); }

MachinePath machine_path(const std::shared_ptr<const Path>& tool, const std::shared_ptr<const Orientation>& orientation,
                         const std::vector<std::shared_ptr<const Kinematics>>& configurations) {
  if (configurations.empty()) throw std::invalid_argument("no machine");
  MachinePath best;
  std::optional<UnreachablePose> furthest;
  for (const auto& kinematics : configurations) {
    try {
      MachinePath candidate{kinematics, std::make_shared<const KinematicAxisPath>(tool, kinematics, orientation), {}};
      candidate.spans = axis_spans(*candidate.axes);
      hold_ranges(*candidate.axes, candidate.spans);
      for (const AxisSpan& span : candidate.spans) candidate.travel += span.travel;
      if (!best.axes || candidate.travel < best.travel) best = std::move(candidate);
    } catch (const UnreachablePose& e) {
      if (!furthest || e.path_length > furthest->path_length) furthest = e;
    }
  }
  if (!best.axes) throw UnreachablePose(*furthest);
  return best;
}

}  // namespace bahnwerk
