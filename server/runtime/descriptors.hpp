#pragma once
#include <cstddef>

namespace bahnwerk::server {

/// Returns the number of files and sockets that this process may have open, after raising the limit towards `wanted` as
/// far as the system allows.
std::size_t raise_descriptors(std::size_t wanted);

/// Returns the number of files and sockets that this process has open, and how many it may have.
std::size_t open_descriptors();
std::size_t max_descriptors();

}  // namespace bahnwerk::server
