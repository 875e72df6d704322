#include "server/store/problems.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bahnwerk::server {
namespace {

TEST(StoreProblems, EachNamesItsJobAndHasATypeOfItsOwn) {
  const std::string id = "0190-a";
  const std::string texts[] = {cancelled_error(id), deadline_error(id), lost_error(id, 3)};
  const char* types[] = {"cancelled", "deadline-exceeded", "worker-lost"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto document = nlohmann::json::parse(texts[i]);
    EXPECT_EQ(document["instance"], "/v1/jobs/" + id);
    EXPECT_TRUE(document["type"].get<std::string>().ends_with(types[i])) << document;
    EXPECT_FALSE(document["detail"].get<std::string>().empty());
  }
  EXPECT_NE(texts[2].find("3 times"), std::string::npos);
}

}  // namespace
}  // namespace bahnwerk::server
