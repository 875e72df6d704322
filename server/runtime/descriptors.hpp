#pragma once
#include <cstddef>

namespace bahnwerk::server {

/// How many files and sockets this process may have open, after raising the limit towards `wanted` as far as the system
/// lets it.
std::size_t raise_descriptors(std::size_t wanted);

}  // namespace bahnwerk::server
