#include "server/http/handover.hpp"

#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <thread>

namespace bahnwerk::server {
namespace {

/// Awaits the value while `work` runs on another thread.
template <class Value, class Work>
Value awaited(Work work) {
  asio::io_context context;
  auto handover = std::make_shared<Handover<Value>>(context.get_executor());
  std::optional<Value> value;
  asio::co_spawn(
      context, [&, handover]() -> asio::awaitable<void> { value = co_await handover->get(); }, asio::detached);
  std::thread other([&] { work(std::move(handover)); });
  other.join();
  context.run();
  return value.value();
}

TEST(Handover, TheFirstValueCounts) {
  EXPECT_EQ(awaited<int>([](std::shared_ptr<Handover<int>> to) {
              Handover<int>::set(to, 1);
              Handover<int>::set(to, 2);
            }),
            1);
}

TEST(Handover, AValueThatIsThereBeforeAnyoneWaitsIsKept) {
  asio::io_context context;
  const auto handover = std::make_shared<Handover<int>>(context.get_executor());
  Handover<int>::set(handover, 5);
  context.run();
  context.restart();
  int value = 0;
  asio::co_spawn(
      context, [&]() -> asio::awaitable<void> { value = co_await handover->get(); }, asio::detached);
  context.run();
  EXPECT_EQ(value, 5);
}

TEST(Handover, AReplyThatIsDroppedStillAnswers) {
  const Response dropped =
      awaited<Response>([](std::shared_ptr<Handover<Response>> to) { const Promise promise(std::move(to)); });
  EXPECT_EQ(dropped.status, 500);
  const Response answered = awaited<Response>([](std::shared_ptr<Handover<Response>> to) {
    const Promise promise(to);
    Handover<Response>::set(to, text_answer(204, "text/plain", ""));
  });
  EXPECT_EQ(answered.status, 204);
}

}  // namespace
}  // namespace bahnwerk::server
