#include "server/pages/texts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "api/text/accept.hpp"

namespace bahnwerk::server {
namespace {

using Table = std::map<std::string, std::string, std::less<>>;

Table read_table(Language language) {
  Table table;
  const std::string folder = std::string(code(language)) + "/";
  for (const TextFile& file : text_files()) {
    if (!file.name.starts_with(folder)) continue;
    const std::string_view area = file.name.substr(folder.size(), file.name.rfind('.') - folder.size());
    const auto texts = nlohmann::json::parse(file.json);
    for (const auto& [key, text] : texts.items()) table[std::string(area) + "." + key] = text.get<std::string>();
  }
  return table;
}

const Table& table_of(Language language) {
  static const Table english = read_table(Language::en), german = read_table(Language::de);
  return language == Language::de ? german : english;
}

std::optional<Language> named(std::string_view code) {
  if (code == "en") return Language::en;
  if (code == "de") return Language::de;
  return std::nullopt;
}

std::optional<Language> of_cookie(std::string_view cookies) {
  constexpr std::string_view name = "bahnwerk_lang=";
  for (std::size_t at = cookies.find(name); at != cookies.npos; at = cookies.find(name, at + 1))
    if (at == 0 || cookies[at - 1] == ' ' || cookies[at - 1] == ';') return named(cookies.substr(at + name.size(), 2));
  return std::nullopt;
}

/// Returns the language with the largest weight, the earlier one of equals.
std::optional<Language> of_header(std::string_view header) {
  std::optional<Language> best;
  double most = 0;
  while (!header.empty()) {
    const std::size_t comma = std::min(header.find(','), header.size());
    std::string_view range = header.substr(0, comma);
    header.remove_prefix(std::min(comma + 1, header.size()));
    while (range.starts_with(' ')) range.remove_prefix(1);
    double weight = 1;
    if (const std::size_t q = range.find("q="); q != range.npos) {
      weight = 0;
      double digit = 1;
      for (const char c : range.substr(q + 2)) {
        if (c >= '0' && c <= '9')
          weight += digit * (c - '0'), digit /= 10;
        else if (c != '.')
          break;
      }
    }
    const auto language = named(range.substr(0, 2));
    if (language && (range.size() == 2 || range[2] == '-' || range[2] == ';') && weight > most) {
      best = language;
      most = weight;
    }
  }
  return best;
}

}  // namespace

std::string_view code(Language language) { return language == Language::de ? "de" : "en"; }

Language language_of(const Request& request) {
  for (const auto& [name, value] : request.query)
    if (name == "lang")
      if (const auto asked = named(value)) return *asked;
  if (const auto kept = of_cookie(request.header("cookie").value_or(""))) return *kept;
  return of_header(request.header("accept-language").value_or("")).value_or(Language::en);
}

std::string Texts::operator()(std::string_view key, Values values) const {
  const Table& table = table_of(language_);
  const auto found = table.find(key);
  if (found == table.end()) throw std::out_of_range("no text " + std::string(key));
  std::string text;
  for (std::size_t at = 0; at < found->second.size();) {
    const std::size_t open = std::min(found->second.find('{', at), found->second.size());
    text.append(found->second, at, open - at);
    if (open == found->second.size()) break;
    const std::size_t close = std::min(found->second.find('}', open), found->second.size());
    const std::string_view name = std::string_view(found->second).substr(open + 1, close - open - 1);
    const auto value = std::find_if(values.begin(), values.end(), [&](const auto& each) { return each.first == name; });
    if (value != values.end()) text += value->second;
    at = close + 1;
  }
  return text;
}

std::string Texts::find(std::string_view key, std::string_view otherwise) const {
  const auto found = table_of(language_).find(key);
  return found == table_of(language_).end() ? std::string(otherwise) : found->second;
}

std::string Texts::name(std::string_view english) const {
  const std::string key = "names." + std::string(english);
  if (const auto found = table_of(language_).find(key); found != table_of(language_).end()) return found->second;
  const std::size_t last = english.rfind(' ');
  if (last == english.npos) return std::string(english);
  return name(english.substr(0, last)) + std::string(english.substr(last));
}

std::string Texts::number(std::string text) const {
  if (language_ == Language::de) std::replace(text.begin(), text.end(), '.', ',');
  return text;
}

}  // namespace bahnwerk::server
