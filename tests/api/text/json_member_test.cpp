#include "api/text/json_member.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <random>

namespace bahnwerk::api {
namespace {

using nlohmann::json;

/// Returns the string at `path` of a text that comes in pieces of at most `most` bytes.
std::optional<std::string> read(std::string_view text, std::vector<std::string> path, std::size_t most) {
  JsonMember member(std::move(path));
  std::string out;
  for (std::size_t at = 0; at < text.size(); at += most) member.take(text.substr(at, most), out);
  EXPECT_EQ(member.found(), member.ended());
  return member.found() ? std::optional(out) : std::nullopt;
}

TEST(JsonMember, FindsTheStringAtItsPathAlone) {
  const std::string text =
      R"({"a":{"b":"wrong","drawings":{"x.svg":"wrong"}},"x.svg":"wrong","list":[{"details":{"drawings":{"x.svg":"wrong"}}}],)"
      R"("details":{"s":"drawings","drawings":{"y":{"x.svg":"wrong"},"n":[1,"x.svg",{"x.svg":"wrong"}],"x.svg":"right"}}})";
  for (const std::size_t most : {1U, 2U, 7U, 1000U}) {
    EXPECT_EQ(read(text, {"details", "drawings", "x.svg"}, most), "right");
    EXPECT_EQ(read(text, {"details", "drawings", "z.svg"}, most), std::nullopt);
    EXPECT_EQ(read(text, {"a", "b"}, most), "wrong");
    EXPECT_EQ(read(text, {"details", "drawings"}, most), std::nullopt) << "an object is no string";
  }
}

TEST(JsonMember, UnescapesAsTheLibraryDoesHoweverTheTextIsCut) {
  std::mt19937 random(1);
  const auto any = [&] {
    static const std::vector<std::string> parts{"a", "\"", "\\", "\n", "\t", "\x01", "/", "ü",
                                                "€", "😀",  "{",  "]",  ",",  ":",    " "};
    std::string text;
    for (auto n = random() % 12; n > 0; --n) text += parts[random() % parts.size()];
    return text;
  };
  for (int pass = 0; pass < 300; ++pass) {
    json document = json::object();
    for (int k = 0; k < 4; ++k) document[any()] = {{any(), any()}, {"k" + any(), json::array({any(), 1.5, nullptr})}};
    const std::string value = any();
    document["details"] = {{any(), any()}, {"drawings", {{"a\"b", value}, {any(), any()}}}};
    document["details"]["drawings"]["a\"b"] = value;
    for (const bool ascii : {false, true})
      for (const int indent : {-1, 2})
        EXPECT_EQ(read(document.dump(indent, ' ', ascii), {"details", "drawings", "a\"b"}, 1 + random() % 9), value);
  }
}

}  // namespace
}  // namespace bahnwerk::api
