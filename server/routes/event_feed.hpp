#pragma once
#include "server/routes/context.hpp"

namespace bahnwerk::server {

struct HeldKey;  // server/keys/key_ring.hpp

/// A stream of events to one client, of which a kind of stream says what is sent when. For each piece it looks on the
/// pool, and waits with the notifier where there is nothing new.
class EventFeed : public Feed, public std::enable_shared_from_this<EventFeed> {
 public:
  EventFeed(Context& context, std::shared_ptr<const HeldKey> key) : context_(context), key_(std::move(key)) {}
  void next(Ready ready) final;
  void stop() final;

 protected:
  using Clock = Notifier::Clock;
  /// Calls give() or wait() once. Not called any more when the client has left or its key was removed.
  virtual void look() = 0;
  void give(std::optional<std::string> piece);  ///< nullopt: the end
  /// Looks again when the job changes, at `until` at the latest; after progress alone not before `progress_from`.
  void wait(std::string_view job, Clock::time_point until,
            std::optional<Clock::time_point> progress_from = std::nullopt);
  /// Waits a moment while the store is away: the stream stays open.
  void wait_for_store();
  void look_now() { context_.notifier.wake(token_); }  ///< ends a wait that would miss a change
  bool silent_too_long() const { return context_.time.now() >= last_piece_ + context_.event_heartbeat; }

  Context& context_;
  Clock::time_point last_piece_{};

 private:
  void look_later();
  const std::shared_ptr<const HeldKey> key_;  ///< the stream ends when it is removed
  Ready ready_;
  std::atomic<bool> stopped_{false};
  std::atomic<Notifier::Token> token_{0};
};

inline constexpr std::string_view first_piece = "retry: 3000\n\n";    ///< how soon a client asks again, ms
inline constexpr std::string_view sign_of_life = ": still here\n\n";  ///< a comment, which clients leave out

/// Returns one event; `data` is JSON.
std::string event_text(std::string_view name, std::uint64_t id, const nlohmann::ordered_json& data);
Response event_stream(std::shared_ptr<Feed> feed);
std::optional<std::uint64_t> last_event_id(const Request& request);  ///< number of Last-Event-ID; nullopt: none

}  // namespace bahnwerk::server
