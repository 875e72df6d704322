#pragma once
/// The texts of pages in the language of the reader. They stand in server/web/texts, a table per language and area, and
/// the modules of pages use the same tables.
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "server/http/message.hpp"

namespace bahnwerk::server {

enum class Language { en, de };

std::string_view code(Language language);  ///< returns "en" or "de"

/// Returns the language of a request: its parameter `lang`, else the cookie that remembers an earlier one, else the
/// first of Accept-Language [RFC 9110, 12.5.4] that there is, else English.
Language language_of(const Request& request);

/// One table: the area "job" of English is "en/job.json", an object of strings.
struct TextFile {
  std::string_view name, json;
};
std::span<const TextFile> text_files();

class Texts {
 public:
  explicit Texts(Language language) : language_(language) {}
  using Values = std::initializer_list<std::pair<std::string_view, std::string_view>>;
  /// Returns the text of a key, e.g. "job.verified", with the values in place of {names}. It is plain text, not HTML.
  /// Throws std::out_of_range where there is none.
  std::string operator()(std::string_view key, Values values = {}) const;
  /// Returns the text of a key; `otherwise` where there is none.
  std::string find(std::string_view key, std::string_view otherwise) const;
  /// Returns the name of a limit or check, e.g. "acceleration x": its words are in the area "names", what stays is an
  /// axis. Names without a translation stay as they are.
  std::string name(std::string_view english) const;
  /// Returns a number, written with a point, with the decimal sign of the language.
  std::string number(std::string text) const;
  Language language() const { return language_; }

 private:
  Language language_;
};

}  // namespace bahnwerk::server
