#include "server/store/failure.hpp"

#include <gtest/gtest.h>

#include "server/store/values.hpp"

namespace bahnwerk::server {
namespace {

std::string logged(const std::exception& error) {
  testing::internal::CaptureStderr();
  log_failure("call_failed", error, {{"job", "a"}});
  return testing::internal::GetCapturedStderr();
}

TEST(Failure, IsLoggedWithItsFieldsUnlessTheStoreSaysItItself) {
  const std::string line = logged(StoreError("a reason", false));
  EXPECT_NE(line.find("\"event\":\"call_failed\""), std::string::npos) << line;
  EXPECT_NE(line.find("\"job\":\"a\""), std::string::npos) << line;
  EXPECT_NE(line.find("\"detail\":\"a reason\""), std::string::npos) << line;
  EXPECT_EQ(logged(StoreAway("gone")), "");
  EXPECT_EQ(logged(StoreReadOnly("standby")), "");
}

}  // namespace
}  // namespace bahnwerk::server
