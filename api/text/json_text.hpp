#pragma once
/// Strict parser of JSON text [RFC 8259] with limits of depth, size and memory.
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/base/progress.hpp"

namespace bahnwerk::api {

inline constexpr std::size_t deepest_nesting = 64;

/// Limits: items of an array (the largest number in any schema) and members of an object.
inline constexpr std::size_t max_items = 2'000'000, max_members = 10'000;
/// Largest memory of a document, bytes. Two million points in space take 320 MB, two million segments 540 MB.
inline constexpr std::size_t max_document_memory = std::size_t{768} << 20;
/// Returns an estimate, from the text alone and without allocation, of the memory that the parsed document takes,
/// bytes. Text like "[],[],[]" takes 37 times its length, coordinates about 6 times. Cost: 1 ns per byte.
std::size_t document_memory(std::string_view text);

/// Reads one document. Throws Problem "invalid-json", with line and column in its detail, for anything but one complete
/// value: syntax errors, NaN and Infinity, numbers beyond double, invalid UTF-8, text behind the value, nesting deeper
/// than 64, duplicate keys (with their pointer). Integral numbers up to 2^53 become integers however they are written
/// (2.0, 2e0, -0.0), so that a document has one form. Throws Problem "payload-too-large" before reading anything for
/// more than max_document_memory, and at the first array or object with too many parts. `progress` is asked every few
/// thousand values, as stage "read".
nlohmann::json parse_json(std::string_view text, Progress progress = {});

/// Returns the number of code points of a valid UTF-8 text.
std::size_t count_characters(std::string_view text);

/// Appends the shortest text that reads back as the same double (std::to_chars); null for one that is not finite.
void append_number(std::string& out, double value);

}  // namespace bahnwerk::api
