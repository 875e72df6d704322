#pragma once
/// What changed among the jobs that a client may see, and the streams of it.
#include "server/routes/event_feed.hpp"

namespace bahnwerk::server {

struct News {
  Changes changes;
  std::uint64_t next = 0;  ///< sequence from which to ask on
};

/// Returns the changes after `since`, at most `limit`, of all jobs or of one owner's. A number that the store has not
/// given yet is of another store: then all jobs have to be looked at.
News news(Store& store, std::uint64_t since, std::size_t limit, const std::optional<std::string>& owner);

/// A stream of changes of many jobs, of which a kind of stream says how a change is told. Changes that are near each
/// other are sent together.
class NewsFeed : public EventFeed {
 protected:
  /// Sends the changes after `since`, `limit` at a time, of all jobs or of one owner's.
  NewsFeed(Context& context, const Request& request, std::uint64_t since, std::size_t limit,
           std::optional<std::string> owner)
      : EventFeed(context, request.key), owner_(std::move(owner)), since_(since), limit_(limit) {}

  virtual std::string event_of(const Changed& changed) = 0;  ///< returns the event of a change; empty: none
  virtual std::string more() { return {}; }                  ///< returns what is to be sent beside changes
  /// Returns when to look again for what more() returns, if nothing changes before.
  virtual Clock::time_point look_for_more() const { return Clock::time_point::max(); }

  const std::optional<std::string> owner_;
  std::uint64_t since_;  ///< the last change that the client has

 private:
  void look() final;
  bool changed();

  const std::size_t limit_;
  bool begun_ = false;
};

}  // namespace bahnwerk::server
