#include "server/cli/typed_options.hpp"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

namespace bahnwerk::server::cli {
namespace {

template <class Value>
CLI::Option* add_checked_bytes(CLI::App& app, const std::string& name, Value& value, const std::string& text,
                               std::size_t least) {
  const auto check = [least](const std::string& given) -> std::string {
    const double bytes = std::strtod(given.c_str(), nullptr);
    if (given.empty() || given.find_first_not_of("0123456789") == 0 || !(bytes >= static_cast<double>(least)) ||
        bytes > 1e18)
      return "must be a number of bytes, at least " + std::to_string(least) + ", such as 8MiB";
    return "";
  };
  // Validators run from the last to the first.
  return app.add_option(name, value, text)->transform(CLI::AsSizeValue(false))->check(CLI::Validator(check, "BYTES"));
}

}  // namespace

CLI::Option* add_seconds(CLI::App& app, const std::string& name, std::chrono::milliseconds& value,
                         const std::string& text, double least) {
  constexpr double longest = 86400;
  const auto set = [&value, name, least](double seconds) {
    if (!(seconds >= least && seconds <= longest))
      throw CLI::ValidationError(name, "must be from " + nlohmann::json(least).dump() + " to 86400 s");
    value = std::chrono::milliseconds(std::llround(seconds * 1e3));
  };
  return app.add_option_function<double>(name, set, text)
      ->default_str(std::to_string(value.count() / 1000))
      ->type_name("SECONDS");
}

CLI::Option* add_bytes(CLI::App& app, const std::string& name, std::size_t& value, const std::string& text,
                       std::size_t least) {
  return add_checked_bytes(app, name, value, text, least);
}

CLI::Option* add_bytes(CLI::App& app, const std::string& name, std::optional<std::int64_t>& value,
                       const std::string& text, std::size_t least) {
  return add_checked_bytes(app, name, value, text, least);
}

CLI::Option* add_keeping_time(CLI::App& app, const std::string& name, std::optional<std::int64_t>& ms,
                              const std::string& text) {
  const auto set = [&ms, name](const std::string& given) {
    constexpr double longest = 36500;  // days
    static const std::map<std::string, double, std::less<>> units{
        {"", 1e3}, {"s", 1e3}, {"m", 6e4}, {"h", 3.6e6}, {"d", 8.64e7}};
    char* end = nullptr;
    const double value = std::strtod(given.c_str(), &end);
    const auto unit = units.find(std::string_view(end));
    if (given.empty() || given.find_first_of("0123456789") != 0 || unit == units.end() ||
        !(value * unit->second >= 1e3 && value * unit->second <= longest * 8.64e7))
      throw CLI::ValidationError(name, "must be a time of 1 s to 36500 d, such as 30d, 12h or 3600");
    ms = std::llround(value * unit->second);
  };
  return app.add_option_function<std::string>(name, set, text)->default_str("")->type_name("TIME");
}

}  // namespace bahnwerk::server::cli
