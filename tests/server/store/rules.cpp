#include "server/store/rules.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bahnwerk::server {
namespace {

TEST(StoreRules, ErrorsNameTheirJobAndHaveTypesOfTheirOwn) {
  const std::string id = "0190-a";
  const std::string texts[] = {after_cancel(id).error, after_deadline(id).error, after_loss(id, 3, false).error};
  const char* types[] = {"cancelled", "deadline-exceeded", "worker-lost"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto document = nlohmann::json::parse(texts[i]);
    EXPECT_EQ(document["instance"], "/v1/jobs/" + id);
    EXPECT_TRUE(document["type"].get<std::string>().ends_with(types[i])) << document;
    EXPECT_FALSE(document["detail"].get<std::string>().empty());
  }
  EXPECT_NE(texts[2].find("3 times"), std::string::npos);
}

TEST(StoreRules, AWishToCancelIsNotForgotten) {
  EXPECT_EQ(after_loss("a", 1, true).state, api::JobState::cancelled);
  EXPECT_EQ(after_requeue("a", true).state, api::JobState::cancelled);
  EXPECT_EQ(after_requeue("a", false).state, api::JobState::queued);
  EXPECT_EQ(after_loss("a", 2, false).state, api::JobState::queued);
  EXPECT_EQ(after_loss("a", 3, false).state, api::JobState::failed);
}

}  // namespace
}  // namespace bahnwerk::server
