#include "core/verify/setpoints/difference_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/base/read_rows.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::Worst;

/// One column of positions with the checks of its differences, by their order 1 … 3.
struct Series {
  std::size_t column = 0;
  double shown = 1;
  std::array<std::optional<Check>, 3> limits{};
  std::array<Worst, 3> worst{};
  std::array<double, 4> last{};  ///< the newest first
  std::size_t known = 0;

  void add(double position, double t, double cycle_time) {
    std::rotate(last.rbegin(), last.rbegin() + 1, last.rend());
    last[0] = position / shown;
    known = std::min(known + 1, last.size());
    const auto& [a, b, c, d] = last;
    const std::array<double, 3> differences{a - b, a - 2 * b + c, a - 3 * b + 3 * c - d};
    double power = 1;
    for (std::size_t i = 0; i < differences.size() && i + 1 < known; ++i) {
      power *= cycle_time;
      worst[i].raise(std::abs(differences[i]) / power, t - static_cast<double>(i + 1) / 2 * cycle_time);
    }
  }
};

Checked differences_of(const Check& held) {
  Checked what = held;
  what.quantity = held.quantity == quantity::path ? Quantity{"setpoint path %", CheckGroup::setpoints}
                                                  : Quantity{"setpoint %", CheckGroup::setpoints, true};
  return what;
}

class DifferenceRows final : public RowCheck {
 public:
  explicit DifferenceRows(const DifferenceInput& in)
      : in_(in), width_(in.setpoints.columns().size()), cycle_time_(in.setpoints.cycle_time()) {
    for (std::size_t k = 0; k < in.machine.axes.size(); ++k) {
      const std::string& name = in.machine.axes[k].name;
      add(name, k < in.shown.size() ? in.shown[k] : 1, quantity::axis, name);
    }
    add("s", 1, quantity::path, "");
  }

  void row(std::size_t k, const double* row) override {
    for (Series& series : all_)
      if (series.column < width_) series.add(row[series.column], static_cast<double>(k) * cycle_time_, cycle_time_);
  }

  std::vector<Check> checks() override {
    std::vector<Check> list;
    for (const Series& series : all_)
      for (std::size_t i = 0; i < series.limits.size(); ++i) {
        if (!series.limits[i]) continue;
        const Check& held = *series.limits[i];
        const bool feed = i == 0 && &series == &all_.back();  // whether the series is that of s, which was added last
        const double limit = feed ? held.limit * (1 + in_.feed_tolerance) : held.limit;
        list.push_back(verify::make_check(differences_of(held), limit, series.worst[i]));
        const double order = static_cast<double>(i + 1),
                     off = std::pow(2 / cycle_time_, order) * in_.rounding / series.shown;
        if (series.worst[i].value <= limit + off) list.back().passed = true;
      }
    return list;
  }

 private:
  void add(const std::string& column, double shown, const Quantity& quantity, const std::string& subject) {
    Series series;
    series.shown = shown;
    series.column = column_index(in_.setpoints.columns(), column);
    for (std::size_t i = 0; i < series.limits.size(); ++i)
      if (const Check* held = in_.motion.find(quantity, static_cast<int>(i + 1), subject)) series.limits[i] = *held;
    if (series.column >= width_) series.worst.fill({std::numeric_limits<double>::quiet_NaN(), 0});
    all_.push_back(series);
  }

  DifferenceInput in_;
  std::size_t width_;
  double cycle_time_;
  std::vector<Series> all_;
};

}  // namespace

std::unique_ptr<RowCheck> difference_row_check(const DifferenceInput& input) {
  return std::make_unique<DifferenceRows>(input);
}

std::vector<Check> difference_checks(const DifferenceInput& input, Progress progress) {
  ProgressScope stage_progress(progress.part(1, 1), "verify differences");
  return check_rows(input.setpoints, difference_row_check(input), stage_progress);
}

}  // namespace bahnwerk
