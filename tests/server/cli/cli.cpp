#include "server/cli/cli.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace bahnwerk::server::cli {
namespace {

/// Files in a folder that goes with the test.
struct Files : testing::Test {
  Files() {
    std::string name = (std::filesystem::temp_directory_path() / "bahnwerk-cli-XXXXXX").string();
    folder = mkdtemp(name.data());
  }
  ~Files() override { std::filesystem::remove_all(folder); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return (folder / name).string();
  }
  std::filesystem::path folder;
};

TEST_F(Files, AJobIsTheFilesTextAsItIs) {
  const std::string text = "{ \"kind\": \"contour\" }\r\n";
  EXPECT_EQ(read_job(write("job.json", text), ""), text);
  EXPECT_THROW(read_input((folder / "missing").string()), std::runtime_error);
}

TEST_F(Files, APartProgramReplacesTheContourAndKeepsTheRest) {
  const std::string job =
      write("job.json", R"({"kind":"contour","spec":{"machine":{"axes":[]},"contour":{"points":[[0,0]],
                                              "closed":true,"units":"inch"}}})");
  const auto read = nlohmann::json::parse(read_job(job, write("part.NC", "G1 X5 F60\n")));
  EXPECT_EQ(read["spec"]["contour"], (nlohmann::json{{"units", "inch"}, {"gcode", "G1 X5 F60\n"}}));
  EXPECT_TRUE(read["spec"]["machine"].contains("axes"));
  const auto drawing = nlohmann::json::parse(read_job(job, write("part.DXF", "0\nEOF\n")));
  EXPECT_EQ(drawing["spec"]["contour"]["dxf"], "0\nEOF\n");
  const auto binary =
      nlohmann::json::parse(read_job(job, write("b.dxf", std::string("AutoCAD Binary DXF\r\n\x1a\0", 22))));
  EXPECT_EQ(binary["spec"]["contour"]["dxf"], "QXV0b0NBRCBCaW5hcnkgRFhGDQoaAA==") << "bytes are no JSON";
  EXPECT_THROW(read_job(write("list.json", "[]"), write("p.nc", "")), std::runtime_error);
}

}  // namespace
}  // namespace bahnwerk::server::cli
