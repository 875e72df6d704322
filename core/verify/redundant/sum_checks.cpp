#include "core/verify/redundant/sum_checks.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/read_rows.hpp"
#include "core/verify/rounding.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::Strained;

constexpr double sum_tolerance = 1e-12;  // mm

/// Indices of the columns of one axis and derivative.
struct Triple {
  std::size_t head = 0, coarse = 0, fine = 0, derivative = 0;
  double limit = 0;  // limit of the fine axis
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

class SumRows final : public RowCheck {
 public:
  explicit SumRows(const SumInput& in) : cycle_time_(in.setpoints.cycle_time()) {
    if (!find(in, triples_)) sums_[0].raise(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  }

  void row(std::size_t k, const double* values) override {
    const double t = static_cast<double>(k) * cycle_time_;
    for (const Triple& c : triples_) {
      const double x = values[c.head], coarse = values[c.coarse], rest = values[c.fine];
      const auto off = static_cast<double>(std::abs(static_cast<long double>(coarse) + rest - x));
      const double tolerance = c.derivative == 0 ? sum_tolerance : verify::rounding * (std::abs(x) + std::abs(coarse));
      sums_[c.derivative].raise(off, tolerance, t);
      if (c.limit < unlimited) fine_[c.derivative].raise(std::abs(rest), c.limit, t);
    }
  }

  std::vector<Check> checks() override {
    using verify::make_check;
    using verify::make_limit_check;
    constexpr CheckGroup setpoints = CheckGroup::setpoints;
    constexpr Quantity fine{"setpoints fine %", setpoints};
    return {make_check({{"setpoints sum", setpoints}, 0}, sums_[0]),
            make_check({{"setpoints sum of velocities", setpoints}, 1}, sums_[1]),
            make_check({{"setpoints sum of accelerations", setpoints}, 2}, sums_[2]),
            make_limit_check({{"setpoints stroke", setpoints}, 0}, fine_[0]),
            make_limit_check({fine, 1}, fine_[1]),
            make_limit_check({fine, 2}, fine_[2])};
  }

 private:
  double cycle_time_;
  std::vector<Triple> triples_;
  std::array<Strained, 3> sums_, fine_;
};

}  // namespace

std::unique_ptr<RowCheck> sum_row_check(const SumInput& input) { return std::make_unique<SumRows>(input); }

std::vector<Check> sum_checks(const SumInput& input, Progress progress) {
  ProgressScope scope(progress, "verify setpoints");
  return check_rows(input.setpoints, sum_row_check(input), scope);
}

}  // namespace bahnwerk
