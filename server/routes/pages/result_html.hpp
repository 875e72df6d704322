#pragma once
/// Parts of a job's page: what a result says, as HTML. All texts of jobs are escaped.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "server/pages/texts.hpp"

namespace bahnwerk::server {

/// Returns a value of a result as HTML: numbers with six digits, members by name, each entry of a list on its own line.
std::string shown_value(const nlohmann::ordered_json& value, const Texts& text);
/// Returns a duration as "3.315 s", "152.97 s", "12 min 33 s" or "1 h 2 min", with a point.
std::string duration_label(double seconds);
/// Returns the duration with the decimal sign of the language.
std::string duration_label(double seconds, const Texts& text);
/// Returns a share as "48 %", with two digits; "0 %" for nothing, "&lt; 0.01 %" for less than that, with a point.
std::string percent(double share);
/// Returns the share with the decimal sign of the language.
std::string percent(double share, const Texts& text);
/// Returns a bar that is full at 1, with its share. Beyond 1 it has the colour of what is far from the optimum. `name`
/// is what the bar shows, for those who cannot see it.
std::string bar(double share, const std::string& name, const Texts& text);
/// Returns a value with its unit; the unit "1" and that of nothing are left out.
std::string with_unit(const nlohmann::ordered_json& value, const nlohmann::ordered_json& unit, const Texts& text);

/// Returns a table of `part`, summary or bound, of a kind's result, with the units of the kind's schema.
std::string figures(const nlohmann::ordered_json& object, const std::string& kind, std::string_view part,
                    const Texts& text);
/// Returns the checks of a verification: failed ones, then limits as bars of use, then all others, folded, with their
/// number and the largest use.
std::string verification(const nlohmann::ordered_json& verdict, const Texts& text);
/// Returns what the bound of a result proves as a sentence, with a gauge that is full where nothing can be gained, and
/// what the bound rests on. Nothing where there is no gap.
std::string bound_sentence(const nlohmann::ordered_json& result, const Texts& text);

}  // namespace bahnwerk::server
