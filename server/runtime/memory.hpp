#pragma once
#include <cstddef>

namespace bahnwerk::server {

/// Size of a document from which on returning memory is worthwhile, bytes.
inline constexpr std::size_t worth_giving_back = 256 << 10;

/// Returns freed memory to the system (glibc; elsewhere without effect). A parsed document consists of millions of
/// small blocks, which the allocator would otherwise reserve for later use. Costs about 1 ms per 100 MB.
void give_back_memory();

/// Returns the resident memory of this process, bytes (Linux; elsewhere 0).
std::size_t resident_memory();

}  // namespace bahnwerk::server
