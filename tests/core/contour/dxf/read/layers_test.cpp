#include "core/contour/dxf/read/layers.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

DxfFile declaring(const char* name, DxfLayer state) {
  DxfFile file;
  state.name = name;
  file.layers.emplace(dxf_lower(name), state);
  return file;
}

TEST(DxfLayers, WithoutAWishEveryLayerIsRead) {
  DxfLayers layers({});
  EXPECT_TRUE(layers["anything"].wanted);
  EXPECT_TRUE(layers.missing().empty());
}

TEST(DxfLayers, NamesDoNotDependOnCase) {
  DxfLayers layers({"cut"});
  DxfLayer frozen;
  frozen.frozen = true;
  layers.declare(declaring("CUT", frozen));
  EXPECT_TRUE(layers["Cut"].wanted);
  EXPECT_TRUE(layers["cUt"].state.frozen);
  EXPECT_FALSE(layers["other"].wanted);
  EXPECT_TRUE(layers.missing().empty());
}

TEST(DxfLayers, AWishThatNothingHasIsAFaultAtItsPlace) {
  DxfLayers layers({"here", "nowhere", "of_an_entity"});
  layers.declare(declaring("Here", {}));
  layers["OF_AN_ENTITY"];
  const auto faults = layers.missing();
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].place, (std::vector<std::string>{"contour", "layers", "1"}));
  EXPECT_NE(faults[0].message.find("Here"), std::string::npos);  // a layer that exists
}

}  // namespace
}  // namespace bahnwerk
