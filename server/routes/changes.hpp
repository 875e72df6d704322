#pragma once
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// GET /v1/changes?since=N: id and state of every job that changed after N, each once, in the order of their last
/// changes, and `next`, from which to ask on. Without `since`: none, and the `next` of now. `gap` says that removals
/// may be missing: a mirror of the jobs has to be compared with the list. `Prefer: wait=SECONDS` delays an empty answer
/// until something changes; with Accept: text/event-stream the changes are sent as they happen, resumed by
/// Last-Event-ID. No thread waits.
void changes(Context& context, const RequestPtr& request, const Reply& reply);

}  // namespace bahnwerk::server
