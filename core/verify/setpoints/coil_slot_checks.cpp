#include "core/verify/setpoints/coil_slot_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/read_rows.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::Worst;

constexpr double step = 1;  // mm, largest distance between two evaluated places
constexpr double radians = std::numbers::pi / 180;
constexpr double nothing = -std::numeric_limits<double>::infinity();

bool number(const ToolPose& pose) {
  return std::isfinite(pose.position.x) && std::isfinite(pose.position.y) && std::isfinite(pose.position.z) &&
         std::isfinite(pose.phi) && std::isfinite(pose.psi);
}

/// Returns the signed distance of a point from a sector, mm, negative inside: that from the nearer of the two planes
/// that bound it.
double beyond(const SlotSector& sector, Vec p) {
  const double c = std::cos(sector.middle), s = std::sin(sector.middle), ahead = c * p.x + s * p.y,
               aside = c * p.y - s * p.x;
  return std::abs(aside) * std::cos(sector.half) - ahead * std::sin(sector.half);
}

class CoilSlotRows final : public RowCheck {
 public:
  explicit CoilSlotRows(CoilSlotInput in) : in_(std::move(in)) {
    const auto& columns = in_.setpoints.columns();
    const char* const names[] = {"x", "y", "z", "phi", "psi", "s"};
    for (std::size_t i = 0; i < column_.size(); ++i)
      missing_columns_ += (column_[i] = column_index(columns, names[i])) >= columns.size();
  }

  bool reads() const override { return missing_columns_ == 0; }

  void row(std::size_t k, const double* row) override {
    const ToolPose pose{
        {row[column_[0]], row[column_[1]], row[column_[2]]}, radians * row[column_[3]], radians * row[column_[4]]};
    const double s = row[column_[5]], t = static_cast<double>(k) * in_.setpoints.cycle_time();
    if (!number(pose) || !std::isfinite(s)) return needle_.raise(std::numeric_limits<double>::quiet_NaN(), t);
    if (k > 0 && !(side(pose) == side_ && side_ != Side::between)) fill(s, t);
    visit(pose, t);
    before_ = s;
  }

  std::vector<Check> checks() override {
    if (side_ == Side::between) finish(Side::between);
    const double missing = static_cast<double>(in_.passes.size()) - static_cast<double>(next_);
    passes_.raise(std::abs(missing) + static_cast<double>(wrong_) + static_cast<double>(missing_columns_), at_);
    return {verify::make_check(named(CheckGroup::limit, "needle outside coil slots", "mm"), 0, needle_),
            verify::make_check(named(CheckGroup::limit, "wire outside coil slots", "mm"), 0, wire_),
            verify::make_check(named(CheckGroup::limit, "passes of coil slots", "1"), 0, passes_)};
  }

 private:
  enum class Side { below, between, above };
  Side side(const ToolPose& pose) const {
    return pose.position.z >= in_.high ? Side::above : pose.position.z <= in_.low ? Side::below : Side::between;
  }
  static bool down(std::size_t pass) { return pass % 2 == 0; }

  /// Visits the path between the row before and the one at s.
  void fill(double s, double t) {
    const double parts = std::ceil(std::abs(s - before_) / step);
    for (double i = 1; i < std::min(parts, 1e6); ++i) {
      const double here = before_ + (s - before_) * i / parts;
      segment_ = in_.path.tool().find(here, segment_);
      visit(in_.path.pose(segment_, in_.path[segment_].parameter(here)), t);
    }
  }

  void visit(const ToolPose& pose, double t) {
    const Side now = side(pose);
    at_ = t;
    if (!started_) {
      started_ = true;
      side_ = entered_ = now == Side::below ? Side::below : Side::above;
      // The motion begins where the first wire lies in its slot; of a short stack that is below it.
      if (now == Side::below && !in_.passes.empty()) complete();
    }
    if (now == Side::between) {
      if (side_ != Side::between) enter(t);
      if (stay_.value == nothing) slot_ = slot_at(pose);
      if (slot_ < in_.passes.size()) stay_.raise(excess(in_.passes[slot_], pose), t);
    } else if (side_ != now) {
      if (side_ != Side::between) enter(t);  // from end to end within a step
      finish(now);
    }
    side_ = now;
  }

  void enter(double t) { entered_ = side_, stay_ = Worst{nothing, t}, slot_ = next_; }

  /// Returns the pass in whose slot the needle is: the next one, or one of the coils that are wound before and after.
  std::size_t slot_at(const ToolPose& pose) const {
    std::size_t best = next_;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t pass : {next_, next_ - 1, next_ - 2, next_ + 1}) {
      if (pass >= in_.passes.size()) continue;  // also what is less than 0
      const double found = excess(in_.passes[pass], pose);
      if (found < least) best = pass, least = found;
      if (found <= 0) break;
    }
    return best;
  }

  /// The needle has left the slots at one end, or the motion has ended between them.
  void finish(Side left) {
    if (stay_.value != nothing) needle_.raise(stay_.value, stay_.at);
    if (left == entered_ || left == Side::between) return;
    const bool expected = next_ < in_.passes.size() && down(next_) == (entered_ == Side::above) &&
                          same(in_.passes[slot_].slot, in_.passes[next_].slot);
    expected ? complete() : static_cast<void>(++wrong_);
  }
  static bool same(const SlotSector& a, const SlotSector& b) {
    return std::abs(std::remainder(a.middle - b.middle, 2 * std::numbers::pi)) < a.half;
  }

  void complete() {
    const SlotPass& pass = in_.passes[next_++];
    for (const Vec place : {pass.wire_in, pass.wire_out}) {
      const double from_axis = std::hypot(place.x, place.y);
      wire_.raise(beyond(pass.wire, place), at_);
      wire_.raise(in_.outside ? in_.edge - from_axis : from_axis - in_.edge, at_);
    }
  }

  /// Returns the largest distance of needle and free wire from the slot's sector.
  double excess(const SlotPass& pass, const ToolPose& pose) const {
    const Vec tip = pose.position,
              d{std::cos(pose.phi) * std::cos(pose.psi), std::sin(pose.phi) * std::cos(pose.psi), -std::sin(pose.psi)};
    return std::max(excess(pass.slot, tip, tip - in_.needle_length * d), excess(pass.slot, tip, pass.wire_in));
  }
  /// Returns the largest distance from a sector of the parts of the line from `a` to `b` that lie between the ends of
  /// the slots and beyond the edge. The distance is convex along the line, so the ends of these parts decide.
  double excess(const SlotSector& sector, Vec a, Vec b) const {
    const Vec way = b - a;
    double first = 0, last = 1;
    if (way.z != 0) {
      const double low = (in_.low - a.z) / way.z, high = (in_.high - a.z) / way.z;
      first = std::max(first, std::min(low, high)), last = std::min(last, std::max(low, high));
    } else if (a.z < in_.low || a.z > in_.high) {
      return nothing;
    }
    if (first > last) return nothing;
    std::array<double, 4> ends{first, last, first, last};
    const double square = way.x * way.x + way.y * way.y, half = a.x * way.x + a.y * way.y,
                 rest = a.x * a.x + a.y * a.y - in_.edge * in_.edge, root = half * half - square * rest;
    if (root >= 0 && square > 0) {
      ends[2] = std::clamp((-half - std::sqrt(root)) / square, first, last);
      ends[3] = std::clamp((-half + std::sqrt(root)) / square, first, last);
    }
    double most = nothing;
    for (const double u : ends) {
      const Vec p = a + u * way;
      const double out = std::hypot(p.x, p.y) - in_.edge;
      if ((in_.outside ? out : -out) >= -1e-9) most = std::max(most, beyond(sector, p));
    }
    return most;
  }

  CoilSlotInput in_;
  std::array<std::size_t, 6> column_{};
  std::size_t missing_columns_ = 0, next_ = 0, wrong_ = 0, segment_ = 0;
  Side side_ = Side::above, entered_ = Side::above;
  bool started_ = false;
  double before_ = 0, at_ = 0;
  std::size_t slot_ = 0;  // pass whose slot the needle is in during the current stay between the ends
  Worst stay_;            // of that stay
  Worst needle_, wire_, passes_;
};

}  // namespace

std::unique_ptr<RowCheck> coil_slot_row_check(CoilSlotInput input) {
  return std::make_unique<CoilSlotRows>(std::move(input));
}

std::vector<Check> coil_slot_checks(CoilSlotInput input, Progress progress) {
  ProgressScope stage_progress(progress.part(1, 1), "verify needle");
  const SetpointSource& setpoints = input.setpoints;
  return check_rows(setpoints, coil_slot_row_check(std::move(input)), stage_progress);
}

}  // namespace bahnwerk
