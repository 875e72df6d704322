#include "server/store/postgres/server_state.hpp"

#include <algorithm>
#include <utility>

#include "server/runtime/jitter.hpp"
#include "server/runtime/log.hpp"

namespace bahnwerk::server {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds least_delay{100}, most_delay{10'000};
constexpr milliseconds attempt_time{2'000};  ///< after which another thread may try, if nothing is heard of an attempt
constexpr std::chrono::seconds between_lines{1}, between_searches{1};

}  // namespace

milliseconds reconnection_delay(int failures, double share) {
  const milliseconds longest = std::min(most_delay, least_delay * (1 << std::clamp(failures - 1, 0, 10)));
  return std::max(least_delay, std::chrono::duration_cast<milliseconds>(longest * share));
}

StoreState PostgresServerState::now() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void PostgresServerState::begin_attempt() {
  const std::lock_guard lock(mutex_);
  if (state_ != StoreState::away) return;
  const auto now = Clock::now();
  if (now < next_attempt_) throw StoreAway("the PostgreSQL server is away");
  next_attempt_ = now + attempt_time;
}

void PostgresServerState::connected(bool read_only) {
  const std::lock_guard lock(mutex_);
  next_attempt_ = {};
  if (std::exchange(failures_, 0) == 0 && state_ == StoreState::away && !read_only)
    state_ = StoreState::up;  // as it should be at the start
  else
    enter(read_only ? StoreState::read_only : StoreState::up);
}

void PostgresServerState::read_only(bool value) {
  const std::lock_guard lock(mutex_);
  if (state_ != StoreState::away) enter(value ? StoreState::read_only : StoreState::up);
}

bool PostgresServerState::search() {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (state_ != StoreState::read_only || now < searched_ + between_searches) return false;
  searched_ = now;
  return true;
}

void PostgresServerState::failed(const std::string& why) {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  ++failures_;
  next_attempt_ = now + reconnection_delay(failures_, random_share());
  outage(now);
  state_ = StoreState::away;
  if (logged_ != Clock::time_point{} && now < logged_ + between_lines) return;
  logged_ = now;
  log::error(name_ + "_away", {{"detail", why}, {"attempts", failures_}});
}

void PostgresServerState::lost() {
  const std::lock_guard lock(mutex_);
  outage(Clock::now());
}

void PostgresServerState::outage(Clock::time_point now) {
  outage_ = true;
  unbroken_since_ = now;
}

void PostgresServerState::answered() {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (answered_ != Clock::time_point{} && now > answered_ + silence_) outage(now);
  answered_ = now;
}

milliseconds PostgresServerState::unbroken() const {
  const std::lock_guard lock(mutex_);
  return std::chrono::duration_cast<milliseconds>(Clock::now() - unbroken_since_);
}

std::optional<milliseconds> PostgresServerState::since_outage() const {
  const std::lock_guard lock(mutex_);
  if (!outage_) return std::nullopt;
  return std::chrono::duration_cast<milliseconds>(Clock::now() - unbroken_since_);
}

void PostgresServerState::enter(StoreState state) {
  if (state == state_) return;
  if (state_ == StoreState::read_only) outage(Clock::now());  // nobody could renew a lease meanwhile
  state_ = state;
  log::info(name_ + (state == StoreState::read_only ? "_read_only" : "_up"));
}

}  // namespace bahnwerk::server
