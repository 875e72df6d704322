#pragma once
/// Content negotiation by Accept headers [RFC 9110, 12.5.1].
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace bahnwerk::api {

/// Returns the index of the offered media type that an Accept header prefers: for each type the most specific range
/// determines q, and the largest q wins; of equal ones the type named more specifically, then the earlier offer.
/// Entries that are not media ranges, or have an invalid q, are ignored. Without a header the first offer is taken;
/// nullopt means that no offer is acceptable.
std::optional<std::size_t> negotiate(std::optional<std::string_view> accept, std::span<const std::string_view> offers);

}  // namespace bahnwerk::api
