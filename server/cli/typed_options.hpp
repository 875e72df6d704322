#pragma once
/// Options of the command line whose values have a unit. Values that cannot be meant end the command with a sentence.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace bahnwerk::server::cli {

/// A duration in seconds, from `least` on: with a shorter one the service could not serve. CLI's own range lets NaN
/// pass.
CLI::Option* add_seconds(CLI::App& app, const std::string& name, std::chrono::milliseconds& value,
                         const std::string& text, double least = 0.1);

/// A number of bytes, at least `least`, with or without a suffix. CLI's own form takes -1 for a very large number.
CLI::Option* add_bytes(CLI::App& app, const std::string& name, std::size_t& value, const std::string& text,
                       std::size_t least = 1);
CLI::Option* add_bytes(CLI::App& app, const std::string& name, std::optional<std::int64_t>& value,
                       const std::string& text, std::size_t least = 1);

/// A time that things are kept: seconds, or with a suffix s, m, h or d.
CLI::Option* add_keeping_time(CLI::App& app, const std::string& name, std::optional<std::int64_t>& ms,
                              const std::string& text);

}  // namespace bahnwerk::server::cli
