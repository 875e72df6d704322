#include "server/pages/texts.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

namespace bahnwerk::server {
namespace {

Request with(Pairs headers, Pairs query = {}) {
  Request request;
  request.headers = std::move(headers);
  request.query = std::move(query);
  return request;
}

TEST(Texts, TheLanguageIsThatOfTheParameterThenOfTheCookieThenOfTheHeader) {
  EXPECT_EQ(language_of(with({})), Language::en);
  EXPECT_EQ(language_of(with({{"accept-language", "de-DE,de;q=0.9,en;q=0.8"}})), Language::de);
  EXPECT_EQ(language_of(with({{"accept-language", "fr,en;q=0.5,de;q=0.7"}})), Language::de);
  EXPECT_EQ(language_of(with({{"accept-language", "den;q=1"}})), Language::en);
  EXPECT_EQ(language_of(with({{"accept-language", "de;q=0"}})), Language::en);
  EXPECT_EQ(language_of(with({{"accept-language", "en"}, {"cookie", "a=b; bahnwerk_lang=de"}})), Language::de);
  EXPECT_EQ(language_of(with({{"cookie", "not_bahnwerk_lang=de"}})), Language::en);
  EXPECT_EQ(language_of(with({{"cookie", "bahnwerk_lang=de"}}, {{"lang", "en"}})), Language::en);
}

TEST(Texts, BothLanguagesHaveTheSameKeysWithTheSameValues) {
  std::set<std::string> keys[2];
  for (const TextFile& file : text_files()) {
    const bool german = file.name.starts_with("de/");
    const auto texts = nlohmann::json::parse(file.json);
    for (const auto& [key, text] : texts.items()) {
      std::set<std::string> names;
      const std::string value = text.get<std::string>();
      EXPECT_FALSE(value.empty()) << key;
      for (std::size_t at = value.find('{'); at != value.npos; at = value.find('{', at + 1))
        names.insert(value.substr(at, value.find('}', at) - at + 1));
      std::string entry = std::string(file.name.substr(3)) + " " + key;
      for (const std::string& name : names) entry += " " + name;
      keys[german].insert(entry);
    }
  }
  EXPECT_FALSE(keys[0].empty());
  EXPECT_EQ(keys[0], keys[1]);
}

TEST(Texts, ValuesStandInPlaceOfTheirNames) {
  const Texts german(Language::de);
  EXPECT_EQ(german("shell.ago_hours", {{"n", "3"}}), "vor 3 h");
  EXPECT_EQ(german.name("acceleration x"), "Beschleunigung x");
  EXPECT_EQ(german.name("coriolis x"), "coriolis x");
  EXPECT_EQ(german.number("3.5"), "3,5");
  EXPECT_EQ(Texts(Language::en).number("3.5"), "3.5");
  EXPECT_THROW(german("shell.nothing"), std::out_of_range);
}

}  // namespace
}  // namespace bahnwerk::server
