#include "server/callbacks/callbacks.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/server/manual_time.hpp"
#include "tests/server/store/fixture.hpp"

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;

struct Call {
  std::string url, signature, body;
};

/// Receivers by URL, which answer what the test says; "hang" does not answer until it is stopped.
class Receivers {
 public:
  Callbacks::Send sender() {
    return [this](const std::string& url, const Pairs& headers, const std::string& body,
                  const std::function<bool()>& stop) {
      std::unique_lock lock(mutex_);
      calls_.push_back({url, headers.back().second, body});
      changed_.notify_all();
      while (url.find("hang") != std::string::npos && !stop()) changed_.wait_for(lock, 1ms);
      if (stop()) throw std::runtime_error("stopped");
      return status_;
    };
  }
  void answer(int status) {
    const std::lock_guard lock(mutex_);
    status_ = status;
  }
  /// Waits for that many calls in all.
  std::vector<Call> calls(std::size_t count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, 60s, [&] { return calls_.size() >= count; }));
    return calls_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Call> calls_;
  int status_ = 200;
};

class CallbacksTest : public testing::Test {
 protected:
  /// Puts in a job with a callback and cancels it.
  std::string ended(const std::string& url) {
    NewJob job = new_job();
    job.request.callback = api::Callback{url, "secret"};
    job.callback_receiver = receiver_of(url);
    const std::string id = insert_id(*store, job);
    store->cancel(id, time.now_ms());
    return id;
  }
  std::unique_ptr<Callbacks> start(unsigned threads = 4) {
    return std::make_unique<Callbacks>(*store, metrics, receivers.sender(), threads, time);
  }
  /// Waits until the job's delivery is as `is` says.
  template <class Is>
  api::Delivery until(const std::string& id, Is&& is) {
    for (int k = 0; k < 60'000; ++k) {
      const auto delivery = store->get(id, false)->delivery;
      if (is(delivery)) return delivery;
      std::this_thread::sleep_for(1ms);
    }
    ADD_FAILURE() << "not within a minute";
    return {};
  }
  TempFolder folder;
  std::unique_ptr<Store> store = std::make_unique<SqliteStore>(SqliteOptions{.path = (folder.path / "a.db").string()});
  ManualTime time;
  Metrics metrics;
  Receivers receivers;
};

TEST_F(CallbacksTest, TheJobIsPostedWithASignatureAndRecordedAsDelivered) {
  const std::string id = ended("http://a/b");
  const auto callbacks = start();
  const auto delivery = until(id, [](const auto& d) { return d.delivered_at.has_value(); });
  EXPECT_EQ(delivery.attempts, 1);
  EXPECT_FALSE(delivery.next_at || delivery.error);
  const Call call = receivers.calls(1)[0];
  EXPECT_EQ(call.signature, callback_signature("secret", time.now_ms() / 1000, call.body));
  const auto body = nlohmann::json::parse(call.body);
  EXPECT_EQ(body["id"], id);
  EXPECT_EQ(body["state"], "cancelled");
  EXPECT_EQ(call.body.find("secret"), std::string::npos);
  EXPECT_NE(metrics.text().find("bahnwerk_callback_attempts_total{outcome=\"delivered\"} 1"), std::string::npos);
}

TEST_F(CallbacksTest, AFailedDeliveryIsTriedAgainAfterItsDelayForADay) {
  receivers.answer(500);
  const std::string id = ended("http://a/b");
  const std::int64_t end = time.now_ms();
  const auto callbacks = start();
  int attempts = 0;
  for (;;) {
    const auto delivery = until(id, [&](const auto& d) { return d.attempts > attempts; });
    attempts = delivery.attempts;
    EXPECT_EQ(delivery.error, "answered 500");
    if (!delivery.next_at) break;
    ASSERT_GT(*delivery.next_at, time.now_ms());
    EXPECT_LE(*delivery.next_at, end + callback_patience_ms);
    time.advance(std::chrono::milliseconds(*delivery.next_at - time.now_ms()));
  }
  EXPECT_EQ(time.now_ms(), end + callback_patience_ms);
  EXPECT_GT(attempts, 24);
  EXPECT_NE(metrics.text().find("bahnwerk_callback_attempts_total{outcome=\"given_up\"} 1"), std::string::npos);
}

TEST_F(CallbacksTest, AReceiverThatHangsHoldsUpNoOther) {
  for (int k = 0; k < 40; ++k) ended("http://hang/" + std::to_string(k));
  const auto callbacks = start();
  receivers.calls(2);
  const std::string id = ended("http://quick/");
  callbacks->notify();
  until(id, [](const auto& d) { return d.delivered_at.has_value(); });
}

TEST_F(CallbacksTest, WhatIsCutOffByTheEndIsDeliveredAtTheNextStart) {
  const std::string id = ended("http://hang/");
  {
    const auto callbacks = start();
    receivers.calls(1);
  }
  EXPECT_EQ(store->get(id, false)->delivery.attempts, 0);
  const auto callbacks = start();
  receivers.calls(2);
}

TEST_F(CallbacksTest, ARemovedJobCallsNobody) {
  store->remove(ended("http://a/b"));
  const std::string id = ended("http://a/c");
  const auto callbacks = start();
  until(id, [](const auto& d) { return d.delivered_at.has_value(); });
  EXPECT_EQ(receivers.calls(1).size(), 1U);
}

TEST(Callbacks, DelaysDoubleUpToAnHour) {
  EXPECT_EQ(callback_delay_ms(1, 1), 2000);
  EXPECT_EQ(callback_delay_ms(1, 0), 1000);
  EXPECT_EQ(callback_delay_ms(5, 1), 32'000);
  EXPECT_EQ(callback_delay_ms(1000, 1), 3'600'000);
  EXPECT_EQ(callback_delay_ms(1000, 0), 1'800'000);
}

TEST(Callbacks, SignaturesAreHmacsOfTimeAndBody) {
  // printf '1700000000.{"a":1}' | openssl dgst -sha256 -hmac key
  EXPECT_EQ(callback_signature("key", 1'700'000'000, R"({"a":1})"),
            "t=1700000000,v1=a438e398bfafc57e4396bb7fc2304422f0f768e965d073ca313cb52e22e6ad03");
}

TEST(HttpSender, RefusesHostsThatAreNotAllowedAndAddressesThatAreNotPublic) {
  const auto never = [] { return false; };
  EXPECT_THROW(http_sender(CallbackHosts())("http://a/", {}, "", never), std::runtime_error);
  const auto send = http_sender(CallbackHosts({"*"}));
  try {
    send("http://127.0.0.1:1/", {}, "", never);
    ADD_FAILURE() << "a private address is called";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("may not be connected to"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace bahnwerk::server
