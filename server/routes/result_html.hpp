#pragma once
/// Parts of a job's page: what a result says, as HTML. All texts of jobs are escaped.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace bahnwerk::server {

/// Returns a value of a result as HTML: numbers with six digits, members by name, each entry of a list on its own line.
std::string shown_value(const nlohmann::ordered_json& value);
/// Returns a duration as "3.315 s", "152.97 s", "12 min 33 s" or "1 h 2 min".
std::string duration_label(double seconds);
/// Returns a share as "48 %", with two digits; "0 %" for nothing, "< 0.01 %" for less than that.
std::string percent(double share);

/// Returns the first line of a result of a kind: verified, or which checks failed; duration; gap to the bound.
std::string verdict_line(const nlohmann::ordered_json& result);
/// Returns a table of `part`, summary or bound, of a kind's result, with the units of the kind's schema.
std::string figures(const nlohmann::ordered_json& object, const std::string& kind, std::string_view part);
/// Returns the three limits with the largest shares of an answer of api::limits_answer() as a table with bars.
std::string largest_limits(const nlohmann::ordered_json& limits);
/// Returns the entries of an answer of api::blocks_document() as a table.
std::string slowest_blocks(const nlohmann::ordered_json& blocks);
/// Returns the checks of a verification: failed ones, then limits as bars of use, then the other groups, folded, each
/// with its number of checks and its largest use.
std::string verification(const nlohmann::ordered_json& verdict);

}  // namespace bahnwerk::server
