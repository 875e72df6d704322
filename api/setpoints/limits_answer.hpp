#pragma once
/// The answer of GET /v1/jobs/{id}/limits: which limit kept the motion from being faster, for how long.
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/views/limits_view.hpp"

namespace bahnwerk::api {

/// An interval of rows.
struct IntervalQuery {
  std::size_t first = 0;
  std::optional<std::size_t> count = {};   ///< rows; none: to the end
  std::optional<std::size_t> points = {};  ///< number of intervals into which it is divided
};
/// Parses first, count and points as parse_setpoint_query() does; throws Problem schema-violation also for other
/// parameters.
IntervalQuery parse_interval_query(const std::vector<std::pair<std::string, std::string>>& query);

/// Largest number of changes of one limit in an answer.
inline constexpr std::size_t max_limit_changes = 1000;

/// Returns the answer for a series of `count` rows. A row stands for the cycle that begins at it; the last row of the
/// series stands for none, unless the interval has no other. Times sum to the interval's duration, fractions to 1.
/// Throws Problem schema-violation for a first row beyond the series.
nlohmann::ordered_json limits_answer(LimitsReader& limits, std::size_t count, double cycle_time,
                                     const IntervalQuery& query);

}  // namespace bahnwerk::api
