#pragma once
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// GET /v1/jobs/{id}/events: a stream of server-sent events [WHATWG HTML, 9.2] that ends after the job's final state or
/// when the service ends. `state` contains the job resource, `progress` its member progress, at most once a second; the
/// id is the job's revision. With Last-Event-ID only later events are sent; 204, which tells a browser not to
/// reconnect, if that was the last one. A comment every 15 s keeps the connection open. No thread waits.
void events(Context& context, const RequestPtr& request, const Reply& reply);

/// GET /v1/events: the same of all jobs that the client may see, or of those of a kind, or that enter a state.
/// `progress` has the job's id, too, `removed` the id of a job that was deleted; `gap` says that the list has to be
/// read again. The id is the number of the change, as in GET /v1/changes. The stream has no end.
void all_events(Context& context, const RequestPtr& request, const Reply& reply);

}  // namespace bahnwerk::server
