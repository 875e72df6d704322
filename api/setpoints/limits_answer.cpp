#include "api/setpoints/limits_answer.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "api/setpoints/setpoints.hpp"
#include "api/text/query_values.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::ordered_json;

std::uint64_t sum(const LimitsReader::Counts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

/// Counts rows [from, to) without the last row of the series, unless that is all there is.
LimitsReader::Counts count_cycles(LimitsReader& limits, std::size_t from, std::size_t to, std::size_t count) {
  const std::size_t end = to == count && to > from + 1 ? to - 1 : to;
  return limits.count(from, end);
}

ordered_json finite(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(); }

/// Writes `value`, the largest permitted value, and `lowest` where that is not the negative of it.
void put_permitted(ordered_json& out, const Permitted& permitted) {
  out["value"] = finite(permitted.highest);
  if (permitted.lowest != -permitted.highest) out["lowest"] = finite(permitted.lowest);
}

ordered_json changes(LimitsReader& limits, std::size_t declared, std::size_t from, std::size_t to, ordered_json& out) {
  const auto found = limits.changes(declared, from, to, max_limit_changes + 1);
  ordered_json list = ordered_json::array();
  for (std::size_t k = 0; k < std::min(found.size(), max_limit_changes); ++k) {
    const std::size_t end = k + 1 < found.size() ? found[k + 1].first : to;
    ordered_json interval{{"first", found[k].first}, {"count", end - found[k].first}};
    put_permitted(interval, found[k].permitted);
    list.push_back(std::move(interval));
  }
  out["more"] = found.size() > max_limit_changes;
  return list;
}

}  // namespace

IntervalQuery parse_interval_query(const std::vector<std::pair<std::string, std::string>>& query) {
  for (const auto& [key, value] : query)
    if (key != "first" && key != "count" && key != "points")
      refuse_parameter(key.substr(0, 100), "unknown parameter; known are first, count, points");
  const SetpointQuery parsed = parse_setpoint_query(query);
  return {parsed.first, parsed.count, parsed.points};
}

ordered_json limits_answer(LimitsReader& limits, std::size_t count, double cycle_time, const IntervalQuery& query) {
  if (query.first > count)
    refuse_parameter(
        "first", "row " + std::to_string(query.first) + " is beyond the series of " + std::to_string(count) + " rows");
  const std::size_t rows = std::min(query.count.value_or(count), count - query.first), end = query.first + rows;
  const auto counts = count_cycles(limits, query.first, end, count);
  const auto total = static_cast<double>(sum(counts));
  const bool timeless = rows == 1 && end == count;  // the last row alone
  const double second = timeless ? 0 : cycle_time;
  ordered_json list = ordered_json::array();
  for (std::size_t id = 0; id < limits.numbers(); ++id) {
    ordered_json each{{"id", id}};
    if (id < row_states) {
      each.update({{"name", limits.name(id)}, {"unit", nullptr}, {"value", nullptr}, {"column", nullptr}});
    } else {
      const DeclaredLimit& limit = limits.list()[id - row_states];
      const std::string& column = limits.column(id - row_states);
      each.update({{"name", limit.name}, {"unit", limit.unit}});
      put_permitted(each, limit.permitted);
      each["column"] = column.empty() ? ordered_json() : ordered_json(column);
      if (!limit.key.empty()) each["intervals"] = changes(limits, id - row_states, query.first, end, each);
    }
    each["time"] = static_cast<double>(counts[id]) * second;
    each["share"] = total > 0 ? static_cast<double>(counts[id]) / total : 0.0;
    list.push_back(std::move(each));
  }
  ordered_json answer{{"first", query.first},
                      {"count", rows},
                      {"cycle_time", cycle_time},
                      {"duration", total * second},
                      {"limits", std::move(list)}};
  if (!query.points) return answer;
  const auto bounds = bucket_bounds(query.first, rows, *query.points, count);
  const std::size_t n = bounds.size() - 1;
  std::vector<std::vector<double>> shares(limits.numbers(), std::vector<double>(n));
  for (std::size_t b = 0; b < n; ++b) {
    const auto part = count_cycles(limits, bounds[b], bounds[b + 1], count);
    const auto all = static_cast<double>(sum(part));
    for (std::size_t id = 0; id < part.size(); ++id) shares[id][b] = static_cast<double>(part[id]) / all;
  }
  answer["points"] = {{"index", std::vector<std::size_t>(bounds.begin(), bounds.end() - 1)},
                      {"shares", std::move(shares)}};
  return answer;
}

}  // namespace bahnwerk::api
