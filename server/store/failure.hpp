#pragma once
#include <exception>
#include <string_view>

#include "server/runtime/log.hpp"

namespace bahnwerk::server {

/// Logs that a call of a store failed. Says nothing where the store is away or can only be read: it says so itself,
/// once a second at most, for all calls together.
void log_failure(std::string_view event, const std::exception& error, log::Fields fields = {});

}  // namespace bahnwerk::server
