#pragma once
/// Notes about a part program beyond its contour: one per matter, with its first line and its count.
#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace bahnwerk::gcode {

/// Collects notes. A matter is identified by its key.
class Notes {
 public:
  /// `key` identifies the matter; its first text remains. O(log matters), of which 64 are stored; a last note says how
  /// often others came.
  void add(int key, std::size_t line, const char* text, std::size_t count = 1) {
    const auto at = entries_.find(key);
    if (at != entries_.end())
      at->second.count += count;
    else if (entries_.size() < most)
      entries_.emplace(key, Entry{text, line, count});
    else
      others_.count += count, others_.line = others_.line == 0 ? line : others_.line;
  }
  /// Replaces the text of a matter that was noted.
  void complete(int key, std::string text) {
    if (const auto at = entries_.find(key); at != entries_.end()) at->second.text = std::move(text);
  }
  /// Returns "line 7 and 2 more: text", ordered by line.
  std::vector<std::string> texts() const {
    std::vector<std::pair<std::size_t, std::string>> list;
    const auto put = [&](const Entry& entry) {
      const std::string more = entry.count > 1 ? " and " + std::to_string(entry.count - 1) + " more" : "";
      list.emplace_back(entry.line, "line " + std::to_string(entry.line) + more + ": " + entry.text);
    };
    for (const auto& [key, entry] : entries_) put(entry);
    if (others_.count > 0) put(others_);
    std::sort(list.begin(), list.end());
    std::vector<std::string> result;
    for (auto& [line, text] : list) result.push_back(std::move(text));
    return result;
  }

 private:
  static constexpr std::size_t most = 64;
  struct Entry {
    std::string text;
    std::size_t line, count;
  };
  std::map<int, Entry> entries_;
  Entry others_{"something else was left out: no more than 64 matters are listed", 0, 0};
};

}  // namespace bahnwerk::gcode
