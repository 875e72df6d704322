#pragma once
/// The problem documents of jobs that a store ends by itself.
#include <cstdint>
#include <string>

namespace bahnwerk::server {

std::string cancelled_error(const std::string& id);
std::string deadline_error(const std::string& id);                   ///< the deadline passed in the queue
std::string lost_error(const std::string& id, std::int64_t losses);  ///< returns the problem document worker-lost

}  // namespace bahnwerk::server
