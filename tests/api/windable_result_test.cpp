#include "api/slot/windable_result.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bahnwerk::api {
namespace {

using winding::Obstruction;
using winding::Producible;

TEST(WindableResult, ObstructionsAreNamedAndWiresCountedFromOne) {
  winding::Windable verdict;
  verdict.wires = 20;
  verdict.blocked = {{{Obstruction::Part::bore, 2.5, 2.0, 0}, false}, {{Obstruction::Part::channel, 0, 0, 6}, true}};
  const auto list = blocked_by(verdict, 20);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0]["part"], "needle");
  EXPECT_EQ(list[0]["passage"], "needle");
  EXPECT_EQ(list[0]["needed"], 2.5);
  EXPECT_EQ(list[1]["part"], "channel");
  EXPECT_EQ(list[1]["wire"], 7);
  EXPECT_EQ(list[1]["region"], "slot_back");
  EXPECT_EQ(blocked_by(verdict, 6).size(), 1u) << "the first six reach their places";
}

TEST(WindableResult, WhatEndsTheWindingIsToldWithItsTurns) {
  winding::Windable verdict;
  verdict.wires = 20;
  EXPECT_EQ(windable(verdict, 2, 20)["wires"], 20);
  EXPECT_EQ(windable(verdict, 2, 20)["turns"], 10);
  EXPECT_TRUE(windable(verdict, 2, 20)["ends_by"].is_null());
  EXPECT_EQ(windable(verdict, 2, 25)["ends_by"], "not_decided");
  EXPECT_TRUE(slips(verdict, 20).is_null());
  verdict.producible.first = Producible::Slip{3, 9, Producible::Reason::pushed_out, true};
  EXPECT_EQ(windable(verdict, 2, 20)["wires"], 9);
  EXPECT_EQ(windable(verdict, 2, 20)["turns"], 4) << "whole ones";
  EXPECT_EQ(windable(verdict, 2, 20)["ends_by"], "pushed_out");
  EXPECT_EQ(slips(verdict, 20)["wire"], 4);
  EXPECT_EQ(slips(verdict, 20)["laid"], 10);
  EXPECT_TRUE(slips(verdict, 9).is_null()) << "it is laid later";
}

}  // namespace
}  // namespace bahnwerk::api
