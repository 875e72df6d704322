#include "api/text/json_range.hpp"

#include <nlohmann/json.hpp>

namespace bahnwerk::api {
namespace {

/// Walks over a JSON text that is known to be valid.
class Walk {
 public:
  Walk(std::string_view text, std::size_t at) : text_(text), at_(at) {}

  /// Returns the bytes of the value that begins at the next character which is no white space, and goes behind it.
  TextRange value() {
    blanks();
    const std::size_t begin = at_;
    if (text_[at_] == '"') {
      string();
    } else if (text_[at_] == '{' || text_[at_] == '[') {
      for (std::size_t depth = 0; at_ < text_.size();) {
        const char c = text_[at_];
        if (c == '"') {
          string();
          continue;
        }
        ++at_;
        if (c == '{' || c == '[') ++depth;
        if ((c == '}' || c == ']') && --depth == 0) break;
      }
    } else {
      at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
    }
    return {begin, at_};
  }

  /// Returns the bytes of the object's member of that name.
  std::optional<TextRange> member(const std::string& name) {
    blanks();
    if (at_ >= text_.size() || text_[at_] != '{') return std::nullopt;
    do {
      ++at_;
      blanks();
      if (text_[at_] == '}') return std::nullopt;
      const TextRange key = value();
      blanks();
      ++at_;  // the colon
      const TextRange range = value();
      if (nlohmann::json::parse(text_.substr(key.begin, key.end - key.begin)) == name) return range;
      blanks();
    } while (at_ < text_.size() && text_[at_] == ',');
    return std::nullopt;
  }

 private:
  void blanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }
  void string() {
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
      if (text_[at_] == '\\') ++at_;
    ++at_;
  }

  const std::string_view text_;
  std::size_t at_;
};

}  // namespace

std::optional<TextRange> value_range(std::string_view json, const std::vector<std::string>& path) {
  TextRange range{0, json.size()};
  for (const std::string& name : path) {
    const auto found = Walk(json, range.begin).member(name);
    if (!found) return std::nullopt;
    range = *found;
  }
  return range;
}

}  // namespace bahnwerk::api
