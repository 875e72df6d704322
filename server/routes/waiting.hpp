#pragma once
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// A request for many jobs that waits for a change. It looks on a pool, and again whenever any job has changed.
class AnyJobWait : public std::enable_shared_from_this<AnyJobWait> {
 public:
  /// Returns the answer if there is something new, or, at the end of the time, in any case (`last`).
  using Look = std::function<std::optional<Response>(bool last)>;
  /// Where it looks, and when.
  struct Schedule {
    Pool& pool;
    int seconds;  ///< longest wait, s
    /// Longest time between two looks: what changes beside states is seen then. nullopt: a change of a state alone is
    /// looked for.
    std::optional<std::chrono::milliseconds> again = std::nullopt;
  };
  AnyJobWait(Context& context, RequestPtr request, Reply reply, Look look, const Schedule& schedule)
      : context_(context),
        pool_(schedule.pool),
        request_(std::move(request)),
        reply_(std::move(reply)),
        wait_(schedule.seconds),
        look_(std::move(look)),
        again_(schedule.again),
        until_(context.time.now() + std::chrono::seconds(wait_)) {}
  void look();  ///< to be called on the pool

 private:
  std::function<void()> look_again();      ///< returns the call that looks on a thread of the pool
  bool changed(std::uint64_t seen) const;  ///< tells whether there were changes, or that cannot be read any more
  Context& context_;
  Pool& pool_;
  const RequestPtr request_;
  const Reply reply_;
  const int wait_;
  const Look look_;
  const std::optional<std::chrono::milliseconds> again_;
  const Notifier::Clock::time_point until_;
  bool listening_ = false;  ///< whether the connection knows that this one waits
  std::atomic<bool> finished_{false};
  std::atomic<Notifier::Token> token_{0};
};

}  // namespace bahnwerk::server
