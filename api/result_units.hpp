#pragma once
/// Units of the figures in results, taken from the descriptions in the schemas.
#include <string>
#include <string_view>

namespace bahnwerk::api {

/// Returns the unit of a member of `part` ("summary", "bound") in the results of a kind, such as "mm/s²"; empty if
/// there is none or it is unknown. A schema's description ends its first statement with the unit: "Planned duration,
/// t_e, s." An object has the unit that all its members have.
std::string result_unit(std::string_view kind, std::string_view part, std::string_view member);

/// Returns the unit that a description states in that form.
std::string described_unit(std::string_view description);

}  // namespace bahnwerk::api
