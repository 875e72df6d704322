#pragma once
/// Structured log: one JSON object per line on stderr, {"time","level","event",…fields}.
#include <nlohmann/json.hpp>
#include <string_view>

namespace bahnwerk::server::log {

enum class Level { debug, info, warn, error };
void set_level(Level level);
void write(Level level, std::string_view event, const nlohmann::ordered_json& fields = nullptr);

inline void info(std::string_view event, const nlohmann::ordered_json& fields = nullptr) {
  write(Level::info, event, fields);
}
inline void warn(std::string_view event, const nlohmann::ordered_json& fields = nullptr) {
  write(Level::warn, event, fields);
}
inline void error(std::string_view event, const nlohmann::ordered_json& fields = nullptr) {
  write(Level::error, event, fields);
}

}  // namespace bahnwerk::server::log
