#include "api/text/json_parts.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <random>

namespace bahnwerk::api {
namespace {

using nlohmann::json;

std::string parts_of(const std::string& text, const std::vector<std::string>& paths, std::size_t piece = 1) {
  JsonParts parts(paths);
  for (std::size_t at = 0; at < text.size() && parts.take(std::string_view(text).substr(at, piece)); at += piece) {
  }
  return parts.document();
}

TEST(JsonParts, PutsMembersTogetherAsTheyAre) {
  const std::string text = R"({"a": {"b": 1.50, "c": [1, {"d": 2}]}, "d": "}\",{", "e": {"b": null}})";
  for (const std::size_t piece : {1U, 2U, 7U, 1000U}) {
    EXPECT_EQ(parts_of(text, {"a.b", "d"}, piece), R"({"a":{"b":1.50},"d":"}\",{"})");
    EXPECT_EQ(parts_of(text, {"e", "a.c", "a.b"}, piece), R"({"a":{"b":1.50,"c":[1, {"d": 2}]},"e":{"b": null}})");
    EXPECT_EQ(parts_of(text, {"a.c.d", "b", "d.x"}, piece), "{}");
    EXPECT_EQ(parts_of(text, {"a.b", "a"}, piece), R"({"a":{"b": 1.50, "c": [1, {"d": 2}]}})");
  }
}

TEST(JsonParts, StopsBehindTheLastOne) {
  JsonParts parts({"a"});
  EXPECT_TRUE(parts.take(R"({"x": 1, "a": 2)"));
  EXPECT_FALSE(parts.take(R"(, "b": 3)"));
  EXPECT_EQ(parts.document(), R"({"a":2})");
}

json random_value(std::mt19937& random, int depth) {
  switch (random() % (depth > 3 ? 3 : 6)) {
    case 0:
      return 1.5;
    case 1:
      return "x,}]{\"\\ \n:";
    case 2:
      return nullptr;
    case 3: {
      json list = json::array();
      for (auto i = random() % 3; i > 0; --i) list.push_back(random_value(random, depth + 1));
      return list;
    }
    default: {
      json object = json::object();
      for (const char* name : {"a", "b", "c", "q\"\\z"})
        if (random() % 3) object[name] = random_value(random, depth + 1);
      return object;
    }
  }
}

TEST(JsonParts, RandomPartsOfRandomDocumentsAreThoseOfAParser) {
  std::mt19937 random(1);
  const std::vector<std::string> names{"a", "b", "c"};
  for (int trial = 0; trial < 5000; ++trial) {
    json document = json::object();
    for (const auto& name : names)
      if (random() % 4) document[name] = random_value(random, 1);
    std::vector<std::string> paths(1 + random() % 3);
    json expected = json::object();
    for (std::string& path : paths) {
      const json* from = &document;
      json::json_pointer place;
      for (auto depth = 1 + random() % 3; depth > 0; --depth) {
        const std::string& name = names[random() % 3];
        path += (path.empty() ? "" : ".") + name;
        place /= name;
        from = from && from->is_object() && from->contains(name) ? &(*from)[name] : nullptr;
      }
      if (from) expected[place] = *from;
    }
    const std::string text = document.dump(random() % 2 ? -1 : 1);
    ASSERT_EQ(json::parse(parts_of(text, paths, 1 + random() % 9)), expected) << text;
  }
}

}  // namespace
}  // namespace bahnwerk::api
