#pragma once
#include <cstddef>

namespace bahnwerk::server {

/// A document of so many bytes leaves enough behind to be worth giving back.
inline constexpr std::size_t worth_giving_back = 256 << 10;

/// Returns to the system what was freed (glibc; elsewhere without effect). A parsed document is millions of small
/// blocks, and the allocator keeps them for a next one that may never come. Costs about 1 ms per 100 MB.
void give_back_memory();

}  // namespace bahnwerk::server
