#pragma once
/// Reads one string of a JSON text that arrives in pieces, in memory that does not grow with the text.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

/// Finds the string at a path of member names in a valid JSON document and unescapes it. Cost: 1 ns per byte outside of
/// strings, less within.
class JsonMember {
 public:
  /// The names of the members from the root on; at least one.
  explicit JsonMember(std::vector<std::string> path);
  /// Takes the next piece of the text and appends what it holds of the string to `out`.
  void take(std::string_view piece, std::string& out);
  bool found() const { return found_; }  ///< whether the string has begun
  bool ended() const { return ended_; }  ///< whether it is complete; the rest of the text plays no part

 private:
  enum class Inside { nothing, key, other_string, member };
  std::size_t take_string(std::string_view piece, std::size_t at, std::string& out);
  void escaped(char c, std::string& out);
  void code_unit(unsigned unit, std::string& out);
  void end_string();
  void structural(char c);

  const std::vector<std::string> path_;
  std::size_t depth_ = 0;    // open objects and arrays
  std::size_t matched_ = 0;  // names of the path whose objects are open
  bool key_next_ = false;    // whether a string would be a key of the innermost matching object
  bool here_ = false;        // whether the value that follows has the next name of the path
  Inside inside_ = Inside::nothing;
  std::string key_;
  int escape_ = -1;  // -1: none; 0: after the backslash; 1 to 4: hexadecimal digits that are still missing
  unsigned unit_ = 0, high_ = 0;
  bool found_ = false, ended_ = false;
};

}  // namespace bahnwerk::api
