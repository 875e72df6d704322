#pragma once
/// Content negotiation.
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace bahnwerk::api {

/// Which of the offered media types an Accept header prefers [RFC 9110, 12.5.1]: the most specific range decides each
/// type's q, the highest q wins; ties go to the type that was named more specifically, then to the earlier offer.
/// Entries that are no media ranges, or whose q is none, are ignored. Absent header = the first offer; nullopt =
/// nothing acceptable.
std::optional<std::size_t> negotiate(std::optional<std::string_view> accept, std::span<const std::string_view> offers);

}  // namespace bahnwerk::api
