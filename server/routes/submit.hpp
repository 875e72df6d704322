#pragma once
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// POST /v1/jobs: answers 202 only after the job is durable; parses on the pool, waits for the commit without a thread.
void submit(Context& context, const RequestPtr& request, const Reply& reply);

/// POST /v1/jobs/{id}/retry: posts the document of a failed or cancelled job once more. Its check is left to the
/// worker.
void retry(Context& context, const RequestPtr& request, const Reply& reply);

}  // namespace bahnwerk::server
