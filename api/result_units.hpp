#pragma once
/// Units of the figures in results, from the schemas that say what the figures are.
#include <string>
#include <string_view>

namespace bahnwerk::api {

/// The unit of a member of `part` ("summary", "bound") in the results of a kind: "mm/s²"; empty where there is none, or
/// where nothing is known. A schema's description ends its first statement with it: "Planned duration, t_e, s." An
/// object has the unit that all of its members have.
std::string result_unit(std::string_view kind, std::string_view part, std::string_view member);

/// What a description says, in that form.
std::string described_unit(std::string_view description);

}  // namespace bahnwerk::api
