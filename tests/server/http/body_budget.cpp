#include "server/http/body_budget.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace bahnwerk::server {
namespace {

TEST(BodyBudget, SharesTogetherNeverTakeMoreThanThereIs) {
  const auto budget = std::make_shared<BodyBudget>(10);
  BodyBudget::Share first(budget);
  EXPECT_TRUE(first.add(6));
  {
    BodyBudget::Share second(budget);
    EXPECT_FALSE(second.add(5));
    EXPECT_TRUE(second.add(4)) << "what was refused is not taken";
    EXPECT_FALSE(first.add(1));
  }
  EXPECT_TRUE(first.add(4)) << "a share that ends gives back what it took";
  EXPECT_FALSE(first.add(1));
  EXPECT_TRUE(first.add(0));
}

TEST(BodyBudget, NothingIsLostBetweenThreads) {
  const auto budget = std::make_shared<BodyBudget>(7);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 2000; ++i) {
        BodyBudget::Share share(budget);
        for (const std::size_t bytes : {3, 3, 3}) share.add(bytes);
      }
    });
  for (std::thread& thread : threads) thread.join();
  BodyBudget::Share all(budget);
  EXPECT_TRUE(all.add(7));
  EXPECT_FALSE(all.add(1));
}

}  // namespace
}  // namespace bahnwerk::server
