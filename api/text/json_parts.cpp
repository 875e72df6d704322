#include "api/text/json_parts.hpp"

#include <algorithm>

#include "api/text/query_values.hpp"

namespace bahnwerk::api {
namespace {

bool begins_with(const std::vector<std::string>& path, const std::vector<std::string>& with) {
  return path.size() >= with.size() && std::equal(with.begin(), with.end(), path.begin());
}

}  // namespace

JsonParts::JsonParts(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) parts_.push_back({split(path, '.'), {}, false});
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) { return a.path < b.path; });
  const auto last = std::unique(parts_.begin(), parts_.end(),
                                [](const Part& a, const Part& b) { return begins_with(b.path, a.path); });
  parts_.erase(last, parts_.end());
  missing_ = parts_.size();
}

bool JsonParts::take(std::string_view piece) {
  std::size_t from = 0;  // begin of what is not yet appended to the value being taken
  for (std::size_t at = 0; at < piece.size() && missing_ > 0; ++at) {
    const char c = piece[at];
    if (in_string_) {
      if (escape_) {
        escape_ = false;
      } else if (c == '\\') {
        escape_ = true;
      } else if (c == '"') {
        in_string_ = false;
        continue;
      }
      if (is_key_) key_ += c;
      continue;
    }
    if (c == '"') {
      in_string_ = true;
      is_key_ = key_next_;
      if (is_key_) key_.clear();
      key_next_ = false;
      continue;
    }
    if (taking_ && depth_ == taking_depth_ && (c == ',' || c == '}')) {
      taking_->value.append(piece, from, at - from);
      end_value();
    }
    const bool taking = taking_ != nullptr;
    structural(c);
    if (!taking && taking_) from = at + 1;
  }
  if (taking_) taking_->value.append(piece, from);
  return missing_ > 0;
}

void JsonParts::structural(char c) {
  if (c == '{' || c == '[') {
    // An object is looked into if its members have names that lead to a part.
    key_next_ = c == '{' && !taking_ && place_.size() == depth_;
    ++depth_;
  } else if (c == '}' || c == ']') {
    --depth_;
    if (place_.size() > depth_) place_.resize(depth_);
  } else if (c == ':') {
    begin_value();
  } else if (c == ',') {
    if (!taking_ && place_.size() >= depth_) place_.resize(depth_ - 1);
    key_next_ = !taking_ && place_.size() + 1 == depth_;
  }
}

/// Begins the value of the member key_ of the object at place_.
void JsonParts::begin_value() {
  if (taking_ || place_.size() + 1 != depth_) return;
  place_.push_back(key_);
  bool leads = false;
  for (Part& part : parts_) {
    leads = leads || begins_with(part.path, place_);
    if (part.found || part.path != place_) continue;
    part.found = true;
    taking_ = &part;
    taking_depth_ = depth_;
    return;
  }
  if (!leads) place_.pop_back();
}

void JsonParts::end_value() {
  taking_ = nullptr;
  --missing_;
}

std::string JsonParts::document() const {
  std::string out = "{";
  std::vector<std::string> open;
  bool first = true;
  const auto name = [&](const std::string& text) { out += (first ? "\"" : ",\"") + text + "\":"; };
  for (const Part& part : parts_) {
    if (!part.found) continue;
    while (!begins_with(part.path, open)) {
      out += '}';
      open.pop_back();
      first = false;
    }
    while (open.size() + 1 < part.path.size()) {
      name(part.path[open.size()]);
      out += '{';
      open.push_back(part.path[open.size()]);
      first = true;
    }
    name(part.path.back());
    constexpr const char* blanks = " \t\n\r";
    const std::size_t begin = part.value.find_first_not_of(blanks), end = part.value.find_last_not_of(blanks);
    out.append(part.value, begin, end - begin + 1);
    first = false;
  }
  return out + std::string(open.size() + 1, '}');
}

}  // namespace bahnwerk::api
