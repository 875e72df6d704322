#include "server/store/postgres/signals.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>

namespace bahnwerk::server {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds between_signals{20};
constexpr milliseconds burst{80};              ///< what may be sent sooner after a rest: claim and end of a short job
constexpr milliseconds between_attempts{100};  ///< the server's state refuses those that are not due
constexpr std::chrono::seconds between_looks{30};  ///< at the end of the process; nothing else is missed meanwhile

void wake_up(int descriptor) {
  const std::uint64_t one = 1;
  (void)!::write(descriptor, &one, sizeof one);
}

void take(int descriptor) {
  std::uint64_t count = 0;
  (void)!::read(descriptor, &count, sizeof count);
}

}  // namespace

PostgresSignals::PostgresSignals(const PostgresConnections& connections, std::string process)
    : connections_(connections), process_(std::move(process)), wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  thread_ = std::thread([this] { loop(); });
}

PostgresSignals::~PostgresSignals() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_up(wake_);
  thread_.join();
  ::close(wake_);
}

void PostgresSignals::tell() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(due_, true)) return;
  }
  wake_up(wake_);
}

void PostgresSignals::listen(std::function<void()> call) {
  const std::lock_guard lock(listener_mutex_);
  listener_ = std::move(call);
}

void PostgresSignals::call() {
  const std::lock_guard lock(listener_mutex_);
  if (listener_) listener_();
}

void PostgresSignals::rest(milliseconds time) const {
  pollfd wake{wake_, POLLIN, 0};
  ::poll(&wake, 1, static_cast<int>(time.count()));
}

void PostgresSignals::loop() {
  for (;;) {
    {
      const std::lock_guard lock(mutex_);
      if (stop_) return;
      due_ = false;  // whoever comes back looks whether anything was missed
    }
    try {
      const auto connection = connections_.make();
      connection->script("SET synchronous_commit = off; LISTEN bahnwerk");
      call();
      serve(*connection);
    } catch (const StoreReadOnly&) {  // a standby has no signals
      rest(std::chrono::seconds(1));
    } catch (const StoreError&) {
      rest(between_attempts);
    }
    take(wake_);
  }
}

/// Returns at the end of the process; throws StoreError when the connection is lost.
void PostgresSignals::serve(PostgresConnection& connection) {
  auto next = Clock::now();
  for (;;) {
    bool due = false;
    {
      const std::lock_guard lock(mutex_);
      if (stop_) return;
      if (due_ && Clock::now() >= next) due = std::exchange(due_, false);
      if (due_) take(wake_);
    }
    if (due) {
      connection.run("SELECT pg_notify('bahnwerk', $1)", PostgresParameters() << process_);
      next = std::max(next, Clock::now() - burst) + between_signals;
    }
    bool waiting = false;
    {
      const std::lock_guard lock(mutex_);
      waiting = due_;
    }
    const auto heard = connection.wait_for_signals(wake_, waiting ? next : Clock::now() + between_looks);
    take(wake_);
    if (std::any_of(heard.begin(), heard.end(), [this](const std::string& each) { return each != process_; })) call();
  }
}

}  // namespace bahnwerk::server
