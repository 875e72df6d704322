#include "api/text/json_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

/// Builds the document and stops at the first fault; the library's own builder takes any depth and lets a later key
/// win.
class Builder : public nlohmann::json_sax<json> {
 public:
  explicit Builder(Progress progress) : progress_(progress) {}
  json root;
  std::string fault;          // text of the fault; empty: none
  bool too_large = false;     // the fault is one of size
  std::string fault_pointer;  // JSON pointer of a fault that is a member of the document
  std::size_t fault_byte = 0;

  bool null() override { return place(nullptr); }
  bool boolean(bool value) override { return place(value); }
  bool number_integer(number_integer_t value) override { return place(value); }
  bool number_unsigned(number_unsigned_t value) override {
    // An integer has one form: signed where it fits, because the schema compares numbers in that form.
    if (value <= static_cast<number_unsigned_t>(std::numeric_limits<number_integer_t>::max()))
      return place(static_cast<number_integer_t>(value));
    return place(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t&) override {
    constexpr double exact = 9007199254740992.0;  // 2^53
    if (!std::isfinite(value)) return fail("a number is beyond the range of a double");
    if (std::abs(value) <= exact && value == std::floor(value)) return place(static_cast<number_integer_t>(value));
    return place(value);
  }
  bool string(string_t& value) override { return place(std::move(value)); }
  bool binary(binary_t&) override { return fail("binary data"); }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& value) override {
    if (stack_.back()->size() >= max_members) return fail_for_size("an object", "members", max_members);
    auto [member, fresh] = stack_.back()->get_ref<json::object_t&>().emplace(std::move(value), nullptr);
    slot_ = &member->second;
    if (fresh) return true;
    fault_pointer = where(member->first);
    return fail("duplicate key " + in_quotes(member->first));
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    fault_byte = position;
    return fail(describe(error.what()));
  }

 private:
  static constexpr std::size_t values_per_report = 4096;  // 0.5 ms
  Progress progress_;
  std::size_t values_ = 0;
  std::vector<json*> stack_;
  json* slot_ = nullptr;  // place for the value of the last key

  bool fail(std::string what) {
    fault = std::move(what);
    return false;
  }
  bool fail_for_size(const std::string& what, const std::string& parts, std::size_t most) {
    too_large = true;
    return fail(what + " has more than " + std::to_string(most) + " " + parts);
  }
  template <class T>
  bool place(T&& value) {
    return put(std::forward<T>(value)) || fail_for_size("an array", "items", max_items);
  }
  json* put(json value) {
    if (++values_ % values_per_report == 0) progress_.report("read", 0);
    if (stack_.empty()) return &(root = std::move(value));
    if (stack_.back()->is_object()) return &(*slot_ = std::move(value));
    auto& array = stack_.back()->get_ref<json::array_t&>();
    if (array.size() >= max_items) return nullptr;
    array.push_back(std::move(value));
    return &array.back();
  }
  bool open(json value) {
    if (stack_.size() == deepest_nesting)
      return fail("nested deeper than " + std::to_string(deepest_nesting) + " levels");
    json* placed = put(std::move(value));
    if (!placed) return fail_for_size("an array", "items", max_items);
    stack_.push_back(placed);
    return true;
  }
  bool close() {
    stack_.pop_back();
    return true;
  }
  std::string where(const std::string& last) const {
    std::string result;
    for (std::size_t i = 0; i + 1 < stack_.size(); ++i) {
      if (stack_[i]->is_array()) {
        append_token(result, std::to_string(stack_[i]->size() - 1));
        continue;
      }
      for (const auto& [name, value] : stack_[i]->get_ref<const json::object_t&>())
        if (&value == stack_[i + 1]) append_token(result, name);
    }
    append_token(result, last);
    return result;
  }
  /// Returns the library's message without its name and position, and without bytes that are not text.
  static std::string describe(std::string_view what) {
    const auto skip = [&](std::string_view mark) {
      const auto at = what.find(mark);
      if (at != what.npos) what.remove_prefix(at + mark.size());
    };
    skip("] ");
    if (what.starts_with("parse error")) skip(": ");
    std::string clean(what.substr(0, 200));
    std::replace_if(
        clean.begin(), clean.end(), [](char c) { return c < 0x20 || c > 0x7E; }, '?');
    return clean;
  }
};

std::string position(std::string_view text, std::size_t byte) {
  const auto before = text.substr(0, std::min(byte == 0 ? 0 : byte - 1, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto last = before.rfind('\n');
  const auto column = 1 + (last == before.npos ? before.size() : before.size() - last - 1);
  return "line " + std::to_string(line) + ", column " + std::to_string(column) + ": ";
}

}  // namespace

std::size_t document_memory(std::string_view text) {
  // A value takes 16 bytes, in an array that grows by doubling; a container a block of its own, a member a tree's node.
  constexpr std::size_t value = 24, array = 88, object = 64, member = 72;
  std::size_t bytes = value;
  bool inside = false;    // a string
  std::size_t depth = 0;  // beyond deepest_nesting reading ends
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inside) {
      ++bytes;
      if (c == '\\') ++i;
      inside = c != '"';
      continue;
    }
    switch (c) {
      case '"':
        inside = true;
        break;
      case ',':
        bytes += value;
        break;
      case '[':
      case '{':
        bytes += c == '[' ? array : object;
        if (++depth > deepest_nesting) return bytes;
        break;
      case ']':
      case '}':
        if (depth > 0) --depth;
        break;
      case ':':
        bytes += member;
        break;
      default:
        break;
    }
  }
  return bytes;
}

json parse_json(std::string_view text, Progress progress) {
  constexpr std::size_t always_small = 1 << 20;
  if (text.size() > always_small)
    if (const std::size_t bytes = document_memory(text); bytes > max_document_memory)
      throw Problem("payload-too-large", "The document has too many parts: read, it would take " +
                                             std::to_string(bytes >> 20) + " MiB of memory, at most " +
                                             std::to_string(max_document_memory >> 20) + " MiB are allowed.");
  Builder builder(progress);
  const bool read = json::sax_parse(text.begin(), text.end(), &builder);
  if (const std::size_t nul = text.find('\0'); read && nul != text.npos)  // the library takes it for the end
    throw Problem("invalid-json", position(text, nul + 1) + "a NUL byte");
  if (read) return std::move(builder.root);
  if (builder.too_large) throw Problem("payload-too-large", "In the document " + builder.fault + ".");
  std::vector<FieldError> errors;
  if (!builder.fault_pointer.empty()) {
    errors.push_back({builder.fault_pointer, builder.fault});
    throw Problem("invalid-json", builder.fault + " at " + builder.fault_pointer, std::move(errors));
  }
  if (builder.fault_byte == 0) throw Problem("invalid-json", builder.fault);
  throw Problem("invalid-json", position(text, builder.fault_byte) + builder.fault);
}

std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

void append_number(std::string& out, double value) {
  if (!std::isfinite(value)) {  // no verified plan holds one; JSON has no word for it
    out += "null";
    return;
  }
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value == 0 ? 0.0 : value).ptr;
  out.append(buffer, end);
}

}  // namespace bahnwerk::api
