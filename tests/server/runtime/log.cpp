#include "server/runtime/log.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bahnwerk::server {
namespace {

/// What `work` writes to stderr.
template <class Work>
std::string written(Work work) {
  testing::internal::CaptureStderr();
  work();
  return testing::internal::GetCapturedStderr();
}

TEST(Log, ALineIsOneObjectWhoseFieldsKeepTheirTypesAndOrder) {
  const std::string line = written([] {
    log::warn("disk_low",
              {{"full", true}, {"share", 0.5}, {"left", -3}, {"bytes", std::size_t{1} << 63}, {"path", "/a"}});
  });
  ASSERT_EQ(line.find('\n'), line.size() - 1);
  const auto json = nlohmann::ordered_json::parse(line);
  std::vector<std::string> names;
  for (const auto& [name, value] : json.items()) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"time", "level", "event", "full", "share", "left", "bytes", "path"}));
  EXPECT_EQ(json["level"], "warn");
  EXPECT_EQ(json["event"], "disk_low");
  EXPECT_EQ(json["full"], true);
  EXPECT_EQ(json["share"], 0.5);
  EXPECT_EQ(json["left"], -3);
  EXPECT_EQ(json["bytes"].get<std::uint64_t>(), std::uint64_t{1} << 63);
  EXPECT_EQ(json["path"], "/a");
}

TEST(Log, TextsOfClientsNeitherBreakNorLoseALine) {
  const std::string line = written([] { log::info("request", {{"path", "a\n{\"b\"}\xff"}}); });
  ASSERT_EQ(line.find('\n'), line.size() - 1);
  EXPECT_EQ(nlohmann::json::parse(line)["path"], "a\n{\"b\"}\xef\xbf\xbd");
}

TEST(Log, LinesBelowTheLevelAreLeftOut) {
  log::set_level(log::Level::warn);
  const std::string quiet = written([] { log::info("a"); }), loud = written([] { log::error("b"); });
  log::set_level(log::Level::info);
  EXPECT_EQ(quiet, "");
  EXPECT_NE(loud.find("\"level\":\"error\""), std::string::npos);
  EXPECT_NE(written([] { log::info("c"); }).find("\"event\":\"c\""), std::string::npos);
}

}  // namespace
}  // namespace bahnwerk::server
