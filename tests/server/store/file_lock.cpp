#include "server/store/sqlite/file_lock.hpp"

#include <unistd.h>

#include "fixture.hpp"

namespace bahnwerk::server {
namespace {

std::string refusal(const std::string& path) {
  try {
    const FileLock lock(path);
  } catch (const StoreError& error) {
    return error.what();
  }
  return "";
}

TEST(FileLock, TheSecondOneIsToldWhoHasIt) {
  const TempFolder folder;
  const std::string path = (folder.path / "lock").string();
  {
    const FileLock first(path);
    const std::string why = refusal(path);
    EXPECT_NE(why.find("process " + std::to_string(::getpid())), std::string::npos) << why;
    EXPECT_NE(why.find(path), std::string::npos) << why;
  }
  EXPECT_EQ(refusal(path), "") << "the lock ends with the object, the file stays";
}

TEST(FileLock, AFolderThatDoesNotExistIsNamed) {
  const TempFolder folder;
  const std::string path = (folder.path / "none" / "lock").string();
  const std::string why = refusal(path);
  EXPECT_NE(why.find(path), std::string::npos) << why;
  EXPECT_NE(why.find("No such file"), std::string::npos) << why;
}

}  // namespace
}  // namespace bahnwerk::server
