#include "server/store/open.hpp"

#include <fstream>

#include "fixture.hpp"

namespace bahnwerk::server {
namespace {

std::string refusal(const std::string& url) {
  try {
    check_store(url);
    open_store(url, nullptr);
  } catch (const StoreError& error) {
    return error.what();
  }
  return "";
}

TEST(OpenStore, AMissingFolderIsMadeAndCommitsAreObserved) {
  const TempFolder folder;
  const std::string path = (folder.path / "a" / "b" / "jobs.db").string();
  std::size_t writes = 0;
  const auto store = open_store("sqlite:" + path, [&](double, std::size_t count) { writes += count; });
  EXPECT_TRUE(std::filesystem::exists(path));
  insert_id(*store);
  EXPECT_GE(writes, 1u);
}

TEST(OpenStore, OtherUrlsAreRefusedWithWhatToWrite) {
  for (const char* url : {"", "sqlite:", "mysql:x", "jobs.db", "postgresql:host"})
    EXPECT_NE(refusal(url).find("sqlite:PATH"), std::string::npos) << url;
}

TEST(OpenStore, APathThatCannotBeAStoreIsNamed) {
  const TempFolder folder;
  EXPECT_NE(refusal("sqlite:" + folder.path.string()).find("is a directory"), std::string::npos);
  std::ofstream(folder.path / "file") << "x";
  EXPECT_NE(refusal("sqlite:" + (folder.path / "file" / "jobs.db").string()).find("directory"), std::string::npos);
}

}  // namespace
}  // namespace bahnwerk::server
