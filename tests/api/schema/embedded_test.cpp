#include "api/schema/embedded.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

TEST(ServedSchemas, AreTheFilesOfTheSourceTree) {
  std::set<std::string> names;
  for (const auto& file : test::json_files("schemas")) {
    const auto name = std::filesystem::path(file).stem().string();
    EXPECT_EQ(embedded(name), test::read_file(file)) << name;
    names.insert(name);
  }
  EXPECT_EQ(names.size(), embedded_files().size());
  EXPECT_EQ(embedded("no-such-file"), "");
}

}  // namespace
}  // namespace bahnwerk::api
