#pragma once
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// Shortest time between two pieces of a stream of many jobs: what changes meanwhile is sent together.
inline constexpr std::chrono::milliseconds between_pieces{100};

struct News {
  Changes changes;
  std::uint64_t next = 0;  ///< sequence from which to ask on
};

/// Returns the changes after `since`, at most `limit`, of all jobs or of one owner's. A number that the store has not
/// given yet is of another store: then all jobs have to be looked at.
News news(Store& store, std::uint64_t since, std::size_t limit, const std::optional<std::string>& owner);

/// GET /v1/changes?since=N: id and state of every job that changed after N, each once, in the order of their last
/// changes, and `next`, from which to ask on. Without `since`: none, and the `next` of now. `gap` says that removals
/// may be missing: a mirror of the jobs has to be compared with the list. `Prefer: wait=SECONDS` delays an empty answer
/// until something changes; with Accept: text/event-stream the changes are sent as they happen, resumed by
/// Last-Event-ID. No thread waits.
void changes(Context& context, const RequestPtr& request, const Reply& reply);

}  // namespace bahnwerk::server
