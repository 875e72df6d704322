#pragma once
/// Cuts members out of a JSON text that arrives in pieces, as the bytes they are.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

/// Finds the values at paths of member names in a valid JSON document and puts them together: of {"a": {"b": 1, "c":
/// 2}, "d": 3} the paths a.c and d make {"a":{"c":2},"d":3}. What the document lacks is left out. A path below another
/// one is part of it. Cost: 1 to 2 ns per byte up to the end of the last value found.
class JsonParts {
 public:
  /// Names without dots, joined by dots; at least one, none empty.
  explicit JsonParts(const std::vector<std::string>& paths);
  /// Takes the next piece of the text; returns false once all values are complete.
  bool take(std::string_view piece);
  std::string document() const;  ///< the object of the values found so far

 private:
  struct Part {
    std::vector<std::string> path;
    std::string value;
    bool found = false;
  };
  void structural(char c);
  void begin_value();
  void end_value();

  std::vector<Part> parts_;
  std::size_t missing_;
  std::vector<std::string> place_;  // names of the objects that are open and may hold a part
  std::size_t depth_ = 0;           // open objects and arrays
  Part* taking_ = nullptr;          // part whose value is being taken
  std::size_t taking_depth_ = 0;    // depth at which it began
  bool in_string_ = false, escape_ = false, key_next_ = false, is_key_ = false;
  std::string key_;
};

}  // namespace bahnwerk::api
