#include "core/verify/setpoints/difference_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/read_rows.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::Worst;

/// One column of positions with what is asked of its differences, by their order 1 … 3.
struct Series {
  std::size_t column = 0;
  double shown = 1;
  std::array<const Check*, 3> limits{};
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

}  // namespace

std::vector<Check> difference_checks(const DifferenceInput& in, Progress& progress) {
  const auto& columns = in.setpoints.columns();
  const std::size_t width = columns.size();
  const double cycle_time = in.setpoints.cycle_time();
  std::vector<Series> all;
  const auto add = [&](const std::string& column, double shown, const std::array<std::string, 3>& names) {
    Series series;
    series.shown = shown;
    series.column = column_index(columns, column);
    for (std::size_t i = 0; i < names.size(); ++i)
      for (const Check& check : in.motion.checks)
        if (check.name == names[i]) series.limits[i] = &check;
    all.push_back(series);
  };
  for (std::size_t k = 0; k < in.machine.axes.size(); ++k) {
    const std::string& name = in.machine.axes[k].name;
    add(name, k < in.shown.size() ? in.shown[k] : 1, {"velocity " + name, "acceleration " + name, "jerk " + name});
  }
  add("s", 1, {"path velocity", "path acceleration", "path jerk"});

  for (Series& series : all)
    if (series.column >= width) series.worst.fill({std::numeric_limits<double>::quiet_NaN(), 0});
  for_each_row(
      in.setpoints,
      [&](std::size_t k, const double* row) {
        for (Series& series : all)
          if (series.column < width) series.add(row[series.column], static_cast<double>(k) * cycle_time, cycle_time);
      },
      [&](std::size_t, std::size_t) { progress.report("verify differences", 1); });
  std::vector<Check> checks;
  for (const Series& series : all)
    for (std::size_t i = 0; i < series.limits.size(); ++i) {
      const Check* held = series.limits[i];
      if (!held) continue;
      const bool feed = i == 0 && &series == &all.back();  // of s, which was added last
      const double limit = feed ? held->limit * (1 + in.feed_tolerance) : held->limit;
      checks.push_back(verify::make_check("setpoint " + held->name, held->unit, limit, series.worst[i]));
      const double order = static_cast<double>(i + 1),
                   off = std::pow(2 / cycle_time, order) * in.rounding / series.shown;
      if (series.worst[i].value <= limit + off) checks.back().passed = true;
    }
  return checks;
}

}  // namespace bahnwerk
