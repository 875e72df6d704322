#include "server/callbacks/callbacks.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "server/http/http_client.hpp"
#include "server/runtime/jitter.hpp"
#include "server/runtime/log.hpp"
#include "server/runtime/sha256.hpp"
#include "server/store/failure.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::chrono::milliseconds longest_sleep{10'000};  ///< the system's clock may be set meanwhile
constexpr std::chrono::milliseconds retry_store{1'000};     ///< after the store failed
constexpr unsigned most_per_receiver = 2;

}  // namespace

std::int64_t callback_delay_ms(int failures, double jitter) {
  constexpr double longest = 3'600'000;
  const double delay = std::min(longest, 1000 * std::exp2(std::clamp(failures, 1, 30)));
  return static_cast<std::int64_t>(delay * (0.5 + 0.5 * jitter));
}

std::string callback_signature(const std::string& secret, std::int64_t unix_time, std::string_view body) {
  const std::string t = std::to_string(unix_time);
  return "t=" + t + ",v1=" + hmac_sha256(secret, std::string(t).append(".").append(body));
}

Callbacks::Callbacks(Store& store, Metrics& metrics, Send send, unsigned threads, const TimeSource& time)
    : store_(store),
      metrics_(metrics),
      send_(std::move(send)),
      threads_(threads),
      time_(time),
      pool_(threads),
      thread_([this] { return look(); }, time) {}

Callbacks::~Callbacks() {
  stop();
  thread_.stop();
  pool_.join();
}

void Callbacks::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
}

bool Callbacks::may_begin(const Receiver& receiver) const {
  if (running_ >= threads_) return false;
  if (!receiver.failing) return receiver.jobs.size() < most_per_receiver;
  return receiver.jobs.empty() && failing_ < std::max(1U, threads_ / 2);
}

/// Begins what is due; returns how long to sleep if not notified. The end of a delivery notifies.
std::chrono::milliseconds Callbacks::look() {
  try {
    // What could not be recorded would be delivered again and again.
    if (store_.state() == StoreState::read_only) return retry_store;
    const std::int64_t now = time_.now_ms();
    std::chrono::milliseconds next = longest_sleep;
    std::set<std::string> names;
    for (const auto& [name, due] : store_.callback_receivers()) {
      names.insert(name);
      if (due > now)
        next = std::min(next, std::chrono::milliseconds(due - now));
      else
        while (begin_one(name, now)) {
        }
    }
    const std::lock_guard lock(mutex_);
    std::erase_if(receivers_,
                  [&](const auto& each) { return each.second.jobs.empty() && !names.contains(each.first); });
    return next;
  } catch (const std::exception& error) {
    log_failure("callbacks_failed", error);
    return retry_store;
  }
}

/// Begins the next delivery to a receiver, if there is one and it may.
bool Callbacks::begin_one(const std::string& name, std::int64_t now) {
  std::set<std::string> jobs;
  {
    const std::lock_guard lock(mutex_);
    const Receiver& receiver = receivers_[name];
    if (stop_ || !may_begin(receiver)) return false;
    jobs = receiver.jobs;
  }
  auto list = store_.due_callbacks(name, now, jobs.size() + 1);
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& each) { return !jobs.contains(each.job.id); });
  if (found == list.end()) return false;
  bool failing = false;
  {
    const std::lock_guard lock(mutex_);
    Receiver& receiver = receivers_[name];
    receiver.jobs.insert(found->job.id);
    failing = receiver.failing;
    ++running_;
    if (failing) ++failing_;
  }
  pool_.post([this, name, failing, callback = std::move(*found)] {
    deliver(callback);
    {
      const std::lock_guard lock(mutex_);
      receivers_[name].jobs.erase(callback.job.id);
      --running_;
      if (failing) --failing_;
    }
    notify();
  });
  return true;
}

void Callbacks::deliver(const DueCallback& callback) {
  const auto stopped = [this] {
    const std::lock_guard lock(mutex_);
    return stop_;
  };
  if (stopped()) return;
  const api::Job& job = callback.job;
  const std::string& url = job.request.callback->url;
  const std::string body = api::job_resource(job).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const Pairs headers{{"Content-Type", "application/json"},
                      {"Bahnwerk-Signature", callback_signature(callback.secret, time_.now_ms() / 1000, body)}};
  int status = 0;
  CallbackAttempt attempt{.id = job.id};
  try {
    status = send_(url, headers, body, stopped);
    if (status / 100 != 2) attempt.error = "answered " + std::to_string(status);
  } catch (const std::exception& error) {
    if (stopped()) return;  // it was told to end; the next start tries again
    attempt.error = error.what();
  }
  attempt.now = time_.now_ms();
  const std::string receiver = receiver_of(url);
  const bool delivered = !attempt.error;
  const bool over = attempt.now >= job.finished_at.value_or(0) + callback_patience_ms;
  if (!delivered && !over)
    attempt.next_at = std::min(attempt.now + callback_delay_ms(job.delivery.attempts + 1, random_share()),
                               job.finished_at.value_or(0) + callback_patience_ms);
  {
    const std::lock_guard lock(mutex_);
    receivers_[receiver].failing = !delivered;
  }
  const char* outcome = delivered ? "delivered" : over ? "given_up" : "failed";
  metrics_.callback(outcome);
  log::audit({{"action", "callback"},
              {"job", job.id},
              {"key", job.owner.value_or("")},
              {"receiver", receiver},
              {"attempt", job.delivery.attempts + 1},
              {"status", status},
              {"outcome", outcome},
              {"detail", attempt.error.value_or("")}});
  record(attempt);
}

/// Stores an attempt. While the store fails, for instance because another program has locked it, it is tried again: an
/// attempt that is not known would be repeated at once.
void Callbacks::record(const CallbackAttempt& attempt) {
  for (;;) {
    try {
      return store_.called_back(attempt);
    } catch (const std::exception& error) {
      log_failure("callback_not_recorded", error, {{"job", attempt.id}});
    }
    std::unique_lock lock(mutex_);
    const auto until = time_.now() + retry_store;
    while (!stop_ && time_.now() < until) time_.wait_until(lock, wake_, until);
    if (stop_) return;
  }
}

Callbacks::Send http_sender(CallbackHosts hosts) {
  return [hosts = std::move(hosts)](const std::string& url, const Pairs& headers, const std::string& body,
                                    const std::function<bool()>& stop) {
    if (const std::string refusal = hosts.refusal(url); !refusal.empty()) throw std::runtime_error(refusal);
    RequestLimits limits;
    limits.time = std::chrono::seconds(10);
    limits.answer = 64 << 10;
    limits.may_connect = [&](const std::string& address) { return hosts.may_connect(url, address); };
    limits.stop = stop;
    const std::size_t authority = url.find("://") + 3;
    const std::size_t path = std::min(url.find_first_of("/?", authority), url.size());
    const std::string target = url.substr(path);
    return HttpClient(url.substr(0, path), {}, limits)
        .request("POST", target.starts_with('/') ? target : "/" + target, headers, body)
        .status;
  };
}

}  // namespace bahnwerk::server
