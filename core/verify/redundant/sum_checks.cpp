#include "core/verify/redundant/sum_checks.hpp"

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

using verify::Strained;

constexpr double sum_tolerance = 1e-12;  // mm

/// Columns of one axis and derivative.
struct Triple {
  std::size_t head = 0, coarse = 0, fine = 0, derivative = 0;
  double limit = 0;  // of the fine axis
};

bool find(const SumInput& in, std::vector<Triple>& found) {
  const std::vector<Column>& columns = in.setpoints.columns();
  if (in.coarse.size() != in.head.size() || in.fine.size() != in.head.size()) return false;
  for (std::size_t k = 0; k < in.head.size(); ++k) {
    const std::array limits{in.fine[k].highest, in.fine[k].velocity, in.fine[k].acceleration};
    for (std::size_t d = 0; d < limits.size(); ++d) {
      const std::string prefix = std::array{"", "v", "a"}[d];
      const Triple t{column_index(columns, prefix + in.head[k].name), column_index(columns, prefix + in.coarse[k].name),
                     column_index(columns, prefix + in.fine[k].name), d, limits[d]};
      if (t.head == columns.size() || t.coarse == columns.size() || t.fine == columns.size()) return false;
      found.push_back(t);
    }
  }
  return true;
}

}  // namespace

std::vector<Check> sum_checks(const SumInput& input, Progress& progress) {
  ProgressScope scope(progress, "verify setpoints", input.progress_from, input.progress_to);
  std::vector<Triple> triples;
  std::array<Strained, 3> sums, fine;
  if (!find(input, triples)) sums[0].raise(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  const double rows = static_cast<double>(input.setpoints.count());
  const auto check = [&](std::size_t row, const double* values) {
    const double t = static_cast<double>(row) * input.setpoints.cycle_time();
    for (const Triple& c : triples) {
      const double x = values[c.head], coarse = values[c.coarse], rest = values[c.fine];
      const auto off = static_cast<double>(std::abs(static_cast<long double>(coarse) + rest - x));
      const double tolerance = c.derivative == 0 ? sum_tolerance : verify::rounding * (std::abs(x) + std::abs(coarse));
      sums[c.derivative].raise(off, tolerance, t);
      if (c.limit < unlimited) fine[c.derivative].raise(std::abs(rest), c.limit, t);
    }
  };
  for_each_row(input.setpoints, check, [&](std::size_t done, std::size_t count) {
    scope.done(static_cast<double>(done) / rows);
    scope.work(4 * count);
  });
  scope.done(1);
  scope.report();
  using verify::make_check;
  using verify::make_limit_check;
  return {make_check("setpoints sum", "mm", sums[0]),
          make_check("setpoints sum of velocities", "mm/s", sums[1]),
          make_check("setpoints sum of accelerations", "mm/s²", sums[2]),
          make_limit_check("setpoints stroke", "mm", fine[0]),
          make_limit_check("setpoints fine velocity", "mm/s", fine[1]),
          make_limit_check("setpoints fine acceleration", "mm/s²", fine[2])};
}

}  // namespace bahnwerk
