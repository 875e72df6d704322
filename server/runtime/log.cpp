#include "server/runtime/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

#include "api/text/rfc3339.hpp"
#include "server/runtime/clock.hpp"

namespace bahnwerk::server::log {
namespace {

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> instance = [] {
    auto made = std::make_shared<spdlog::logger>("bahnwerk", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_pattern("%v");
    made->flush_on(spdlog::level::trace);
    return made;
  }();
  return *instance;
}

spdlog::level::level_enum spd(Level level) {
  switch (level) {
    case Level::debug:
      return spdlog::level::debug;
    case Level::info:
      return spdlog::level::info;
    case Level::warn:
      return spdlog::level::warn;
    case Level::error:
      break;
  }
  return spdlog::level::err;
}

constexpr std::string_view names[] = {"debug", "info", "warn", "error"};

}  // namespace

void set_level(Level level) { logger().set_level(spd(level)); }

namespace {

std::string line_of(Level level, std::string_view event, const Fields& fields) {
  nlohmann::ordered_json line{
      {"time", api::rfc3339(now_ms())}, {"level", names[static_cast<int>(level)]}, {"event", event}};
  for (const Field& field : fields)
    std::visit([&](const auto& value) { line[std::string(field.name)] = value; }, field.value.variant());
  // Broken UTF-8 from a client must not lose the line.
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

void write(Level level, std::string_view event, const Fields& fields) {
  if (logger().should_log(spd(level))) logger().log(spd(level), spdlog::string_view_t(line_of(level, event, fields)));
}

void audit(const Fields& fields) {
  logger().log(spdlog::level::critical, spdlog::string_view_t(line_of(Level::info, "audit", fields)));
}

}  // namespace bahnwerk::server::log
