#pragma once
/// The options of `bahnwerk serve`. Each is also a variable of the environment, BAHNWERK_ and the flag's name.
#include <CLI/CLI.hpp>
#include <string>

#include "server/service.hpp"

namespace bahnwerk::server::cli {

/// `level` is the least level logged.
void add_serve_options(CLI::App& app, ServiceOptions& options, std::string& level, std::string& password_file);
/// Adds --store-password-file, which every command with a store has.
void add_password_file(CLI::App& app, std::string& file);

/// Returns a variable that looks like a setting of the service and is none; empty: there is none. Kubernetes makes
/// variables for a service of this name.
std::string unknown_variable(const CLI::App& serve);

}  // namespace bahnwerk::server::cli
