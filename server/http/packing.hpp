#pragma once
#include "server/http/message.hpp"

namespace bahnwerk::server {

/// Packs answers with gzip for clients that accept it, by `offload`, on other threads; events and answers of less than
/// a kilobyte stay as they are. A packed answer is another representation: its ETag ends with -gzip, and such tags are
/// understood in conditions of requests.
Middleware pack_answers(std::function<void(std::function<void()>)> offload);

}  // namespace bahnwerk::server
