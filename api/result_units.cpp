#include "api/result_units.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/kind.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::ordered_json;

bool is_base_unit(std::string_view text) {
  static constexpr std::array<std::string_view, 16> known{"1",  "mm", "m",  "s",   "min", "deg", "rad", "N",
                                                          "Nm", "Ω",  "Hz", "kHz", "kg",  "g",   "°C",  "W"};
  for (const std::string_view power : {"²", "³", "⁴"})
    if (text.ends_with(power)) text.remove_suffix(power.size());
  return std::find(known.begin(), known.end(), text) != known.end();
}

/// Tells whether a text is a unit such as mm, mm², mm/s, mm²/s³.
bool is_unit(std::string_view text) {
  const auto slash = text.find('/');
  if (slash == text.npos) return text != "1" && is_base_unit(text);
  return is_base_unit(text.substr(0, slash)) && is_base_unit(text.substr(slash + 1));
}

const ordered_json& resolved(const ordered_json& schema, const ordered_json& member) {
  if (!member.contains("$ref")) return member;
  return schema.at(ordered_json::json_pointer(member["$ref"].get<std::string>().substr(1)));
}

std::string unit_of(const ordered_json& schema, const ordered_json& member) {
  const ordered_json& described = resolved(schema, member);
  std::string own = described_unit(described.value("description", ""));
  if (!own.empty() || !described.contains("properties") || described["properties"].empty()) return own;
  const ordered_json& members = described["properties"];
  const std::string first = unit_of(schema, members.front());
  const bool same = std::all_of(members.begin(), members.end(),
                                [&](const ordered_json& each) { return unit_of(schema, each) == first; });
  return same ? first : std::string();
}

using Units = std::map<std::pair<std::string, std::string>, std::string, std::less<>>;

/// Units by part and member.
std::map<std::string, Units, std::less<>> all_units() {
  std::map<std::string, Units, std::less<>> all;
  for (const Kind& kind : kinds()) {
    const ordered_json schema = ordered_json::parse(kind.result_schema);
    for (const char* part : {"summary", "bound"}) {
      if (!schema["properties"].contains(part)) continue;
      const ordered_json& object = resolved(schema, schema["properties"][part]);
      if (!object.contains("properties")) continue;
      for (const auto& [name, member] : object["properties"].items())
        all[std::string(kind.name)][{part, name}] = unit_of(schema, member);
    }
  }
  return all;
}

}  // namespace

std::string described_unit(std::string_view description) {
  for (std::size_t at = description.find(", "); at != description.npos; at = description.find(", ", at)) {
    at += 2;
    const std::string_view token = description.substr(at, description.find_first_of(".;,", at) - at);
    const bool ends = at + token.size() == description.size() || description[at + token.size()] != ',';
    if (ends && is_unit(token)) return std::string(token);
  }
  return {};
}

std::string result_unit(std::string_view kind, std::string_view part, std::string_view member) {
  static const auto all = all_units();
  const auto units = all.find(kind);
  if (units == all.end()) return {};
  const auto unit = units->second.find(std::pair{std::string(part), std::string(member)});
  return unit == units->second.end() ? std::string() : unit->second;
}

}  // namespace bahnwerk::api
