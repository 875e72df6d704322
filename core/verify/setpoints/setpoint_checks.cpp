#include "core/verify/setpoints/setpoint_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/progress_scope.hpp"
#include "core/base/read_rows.hpp"
#include "core/verify/rounding.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::epsilon;
using verify::PieceRounding;
using verify::rounding;
using verify::Strained;

/// Returns the larger of two, not-a-number if either is.
double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

class PathRows final : public RowCheck {
 public:
  explicit PathRows(const SetpointInput& in)
      : in_(in),
        path_(in.path),
        pieces_(in.law.pieces()),
        rows_(in.setpoints.count()),
        axes_(in.path.axes()),
        cycle_time_(in.machine.cycle_time) {
    shown_.fill(1);
    std::copy_n(in.shown.begin(), std::min(in.shown.size(), axes_), shown_.begin());
    if (in.lag > 0) lag_ = in.lag * peak_speed(in.law) * cycle_time_;
    const double last = static_cast<double>(rows_) - 1, duration = in_.law.duration();
    const double missing = static_cast<double>(find_columns());
    count_.raise(larger(missing, std::abs(last - std::round(duration / cycle_time_))), 0, 0);
    time_.raise(larger(std::abs(last * cycle_time_ - duration),
                       larger(std::abs(in_.setpoints.duration() - duration),
                              std::abs(in_.setpoints.cycle_time() - cycle_time_) * last)),
                rounding * duration, duration);
    reads_ = missing == 0 && !pieces_.empty() && path_.size() > 0 && rows_ > 0;
    if (reads_) enter(0);
  }

  bool reads() const override { return reads_; }
  void row(std::size_t k, const double* row) override {
    if (k + 1 < rows_)
      check(k, row);
    else
      check_last(row);
  }
  std::vector<Check> checks() override { return report(); }

 private:
  /// Returns the number of missing columns.
  std::size_t find_columns() {
    std::size_t missing = 0;
    const auto& columns = in_.setpoints.columns();
    const auto find = [&](const std::string& name) {
      const std::size_t at = column_index(columns, name);
      missing += at == columns.size();
      return at;
    };
    for (std::size_t k = 0; k < axes_; ++k) {
      const std::string& name = in_.machine.axes[k].name;
      position_column_[k] = find(name), velocity_column_[k] = find("v" + name),
      acceleration_column_[k] = find("a" + name);
    }
    s_column_ = find("s"), v_column_ = find("v");
    if (in_.contour != nullptr) mode_column_ = find("mode"), block_column_ = find("block");
    return missing;
  }

  /// Piece i of the law is the one that rows now lie on.
  void enter(std::size_t i) {
    piece_ = i;
    if (in_.contour == nullptr) return;
    const LawPiece& piece = pieces_[i];
    const auto& rests = in_.contour->rests;
    while (rest_at_ < rests.size() && !(rests[rest_at_].seconds > 0)) ++rest_at_;
    const bool stands = piece.v == 0 && piece.a == 0 && piece.j == 0 && piece.snap == 0;
    if (stands && rest_at_ < rests.size() && at_rest(rests[rest_at_], piece)) {
      block_ = rests[rest_at_++].block;
      return;
    }
    const auto& blocks = in_.contour->blocks;
    while (way_block_ + 1 < blocks.size() && blocks[way_block_].last <= piece.segment) ++way_block_;
    block_ = std::max(block_, way_block_);  // blocks do not decrease behind the rest at the path's end
  }
  /// Returns whether a piece that stands is at the place of that rest: a motion may also wait elsewhere.
  bool at_rest(const Rest& rest, const LawPiece& piece) const {
    if (rest.segment < path_.size()) return piece.segment >= rest.segment;
    const Segment& last = path_[path_.size() - 1];
    return piece.segment + 1 >= path_.size() && piece.s - last.s0() > last.s1() - piece.s;
  }
  double size(const double* x) const {
    double sum = 0;
    for (std::size_t axis = 0; axis < axes_; ++axis) sum += x[axis] * x[axis];
    return std::sqrt(sum);
  }

  void check(std::size_t k, const double* row) {
    const double t = static_cast<double>(k) * cycle_time_, rounding_error = epsilon * t;
    while (piece_ + 1 < pieces_.size() && pieces_[piece_ + 1].t0 <= t) enter(piece_ + 1);
    const LawPiece& piece = pieces_[piece_];
    if (rounding_of_ != piece_) rounding_ = verify::rounding_of(piece), rounding_of_ = piece_;
    const LawState law = piece.at(std::clamp(t - piece.t0, 0.0, std::max(piece.duration, 0.0)));
    const double s = row[s_column_], v = row[v_column_];
    path_column_.raise(std::abs(s - law.s), rounding_.position + std::abs(law.v) * rounding_error + lag_, t);
    speed_.raise(std::abs(v - law.v), rounding_.speed + std::abs(law.a) * rounding_error, t);
    if (k > 0) forward_.raise(std::isnan(s) ? s : std::max(0.0, before_ - s), rounding * path_.length(), t);
    before_ = s;
    label(row, t);
    if (piece.segment >= path_.size()) return position_.raise(std::numeric_limits<double>::infinity(), 0, t);
    std::array<double, 4 * max_axes> all;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled as far as read
    const std::size_t segment = lag_ > 0 ? path_.tool().find(s, piece.segment) : piece.segment;
    path_.write_at(segment, s, all.data());
    const double *q = all.data(), *q1 = q + axes_, *q2 = q1 + axes_;
    const double along = size(q1), a = std::abs(law.a);
    const double place = rounding * (size(q) + along * path_[segment].length()), quick = rounding * along * std::abs(v),
                 quicker = rounding * (v * v * size(q2) + along * a) +
                           along * (rounding_.acceleration + std::abs(law.j) * rounding_error);
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      const double unit = shown_[axis];
      position_.raise(std::abs(row[position_column_[axis]] - unit * q[axis]), unit * place, t);
      velocity_.raise(std::abs(row[velocity_column_[axis]] - unit * (q1[axis] * v)), unit * quick, t);
      acceleration_.raise(std::abs(row[acceleration_column_[axis]] - unit * (q2[axis] * (v * v) + q1[axis] * law.a)),
                          unit * quicker, t);
    }
  }

  void check_last(const double* row) {
    const double t = in_.law.duration();
    while (piece_ + 1 < pieces_.size()) enter(piece_ + 1);
    label(row, t);
    const std::size_t last = path_.size() - 1;
    const AxisArray there = path_.at_parameter(last, path_[last].curve().end()).value;
    double off = std::abs(row[s_column_] - path_.length()), moving = std::abs(row[v_column_]);
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      off = larger(off, std::abs(row[position_column_[axis]] - shown_[axis] * there[axis]));
      moving = larger(moving, std::abs(row[velocity_column_[axis]]));
      moving = larger(moving, std::abs(row[acceleration_column_[axis]]) * cycle_time_);
    }
    end_.raise(off, 0, t);
    rest_.raise(moving, 0, t);
  }

  void label(const double* row, double t) {
    if (in_.contour == nullptr) return;
    const auto& blocks = in_.contour->blocks;
    const bool cut = blocks.empty() || blocks[block_].mode == Mode::cut;
    if (row[mode_column_] == (cut ? 1.0 : 0.0) && row[block_column_] == static_cast<double>(block_)) return;
    if (++mislabelled_ == 1) mislabelled_at_ = t;
  }

  std::vector<Check> report() const {
    using verify::make_check;
    using namespace quantity;
    constexpr CheckGroup setpoints = CheckGroup::setpoints;
    std::vector<Check> checks = {make_check({rows_count, 0, "1"}, count_),
                                 make_check({rows_time, 0, "s"}, time_),
                                 make_check({{"setpoints path", setpoints}, 0}, path_column_),
                                 make_check({{"setpoints speed", setpoints}, 1}, speed_),
                                 make_check({{"setpoints forward", setpoints}, 0}, forward_),
                                 make_check({rows, 0}, position_),
                                 make_check({rows, 1}, velocity_),
                                 make_check({rows, 2}, acceleration_)};
    if (in_.contour != nullptr) {
      Strained labels;
      labels.raise(static_cast<double>(mislabelled_), 0, mislabelled_at_);
      checks.push_back(make_check({{"setpoints mode and block", setpoints}, 0, "1"}, labels));
    }
    checks.push_back(make_check({rows_end, 0}, end_));
    checks.push_back(make_check({{"setpoints end at rest", setpoints}, 1}, rest_));
    return checks;
  }

  SetpointInput in_;
  const AxisPath& path_;
  const LargeVector<LawPiece>& pieces_;
  bool reads_ = false;
  std::size_t rows_, axes_;
  double cycle_time_, lag_ = 0;
  AxisArray shown_{};
  std::array<std::size_t, max_axes> position_column_{}, velocity_column_{}, acceleration_column_{};
  std::size_t s_column_ = 0, v_column_ = 0, mode_column_ = 0, block_column_ = 0;
  std::size_t piece_ = 0, block_ = 0, mislabelled_ = 0;
  std::size_t way_block_ = 0, rest_at_ = 0;  // block of the current segment; the next rest of the contour
  PieceRounding rounding_;
  std::size_t rounding_of_ = static_cast<std::size_t>(-1);
  double before_ = 0, mislabelled_at_ = 0;
  Strained count_, time_, path_column_, speed_, forward_, position_, velocity_, acceleration_, end_, rest_;
};

}  // namespace

std::unique_ptr<RowCheck> path_row_check(const SetpointInput& input) { return std::make_unique<PathRows>(input); }

std::vector<Check> setpoint_checks(const SetpointInput& input, Progress progress) {
  ProgressScope stage_progress(progress, "verify setpoints");
  return check_rows(input.setpoints, path_row_check(input), stage_progress);
}

}  // namespace bahnwerk
