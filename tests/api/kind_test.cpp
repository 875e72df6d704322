#include "api/kind.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "api/documents/openapi.hpp"

namespace bahnwerk::api {
namespace {

TEST(Kinds, AreListedWithTheirSchemas) {
  const auto document = kinds_document();
  ASSERT_EQ(document["kinds"].size(), kinds().size());
  EXPECT_EQ(document["kinds"][0]["name"], "contour");
  EXPECT_EQ(document["kinds"][0]["schema"], "/v1/schemas/contour");
  EXPECT_EQ(document["kinds"][0]["result_schema"], "/v1/schemas/contour.result");
  EXPECT_EQ(find_kind("contour"), &kinds()[0]);
  EXPECT_EQ(find_kind("Contour"), nullptr);
}

TEST(Kinds, EachIsFoundByItsOwnNameAndHasBothSchemas) {
  std::set<std::string_view> names;
  for (const Kind& kind : kinds()) {
    EXPECT_EQ(find_kind(kind.name), &kind);
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_EQ(nlohmann::json::parse(kind.schema)["$id"], "/v1/schemas/" + std::string(kind.name));
    EXPECT_EQ(nlohmann::json::parse(kind.result_schema)["$id"], "/v1/schemas/" + std::string(kind.name) + ".result");
    EXPECT_FALSE(kind.title.empty()) << kind.name;
  }
  EXPECT_EQ(find_kind(""), nullptr);
}

}  // namespace
}  // namespace bahnwerk::api
