#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/problem.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/context.hpp"
#include "server/runtime/descriptors.hpp"
#include "server/runtime/memory.hpp"

namespace bahnwerk::server {
namespace {

Response uncached(Response response) {
  response.set("Cache-Control", "no-store");
  return response;
}

Response ready(Context& context) {
  if (context.draining) throw api::Problem("draining", "The server is about to stop.");
  try {
    context.store.ping();
  } catch (const StoreError& error) {
    throw api::Problem("store-unavailable", std::string("The store cannot be reached: ") + error.what());
  }
  if (context.store.state() == StoreState::read_only)
    return uncached(json_answer(200, {{"status", "ready"}, {"store", "read-only"}}));
  return uncached(json_answer(200, {{"status", "ready"}}));
}

std::string_view name_of(StoreState state) {
  return state == StoreState::up ? "up" : state == StoreState::read_only ? "read_only" : "away";
}

/// Asks the store for what concerns it as a whole; throws StoreError.
void look_at_store(Context& context, Metrics::Observed& seen) {
  const auto counts = context.store.counts();
  const StoreStatus store = context.store.status();
  const double age = store.oldest_queued ? static_cast<double>(context.time.now_ms() - *store.oldest_queued) * 1e-3 : 0;
  for (const auto& [state, count] : counts) context.metrics.jobs(api::to_string(state), static_cast<double>(count));
  context.metrics.store_state(name_of(context.store.state()));
  seen.oldest_queued_seconds = std::max(0.0, age);
  seen.beyond_engine = static_cast<double>(store.beyond_engine);
  seen.callbacks = static_cast<double>(store.callbacks);
  seen.store_bytes = store.bytes;
  seen.store_log_bytes = store.log_bytes;
  seen.store_free_bytes = store.free_bytes;
  seen.dead_rows = store.dead_rows;
  seen.snapshot_seconds = store.snapshot_seconds;
  seen.snapshot_transactions = store.snapshot_transactions;
}

/// Answers also while the store is away: what the process knows by itself is asked for most then.
Response metrics(Context& context) {
  using api::JobState;
  const StoreConnections connections = context.store.connections();
  Metrics::Observed seen{.resident_bytes = static_cast<double>(resident_memory()),
                         .max_memory_bytes = static_cast<double>(memory_limit()),
                         .descriptors = static_cast<double>(open_descriptors()),
                         .max_descriptors = static_cast<double>(max_descriptors()),
                         .workers = static_cast<double>(context.workers),
                         .busy_workers = static_cast<double>(context.live.size()),
                         .busy_connections = static_cast<double>(connections.busy),
                         .idle_connections = static_cast<double>(connections.idle),
                         .max_connections = static_cast<double>(connections.most)};
  try {
    look_at_store(context, seen);
  } catch (const StoreError&) {
    context.metrics.store_state(name_of(StoreState::away));
    for (const auto state :
         {JobState::queued, JobState::running, JobState::succeeded, JobState::failed, JobState::cancelled})
      context.metrics.jobs(api::to_string(state), Metrics::unknown);
  }
  context.metrics.observe(seen);
  return uncached(text_answer(200, "text/plain; version=0.0.4; charset=utf-8", context.metrics.text()));
}

}  // namespace

void add_health_routes(Router& router, Context& context) {
  const nlohmann::ordered_json alive{{"status", "alive"},
                                     {"version", context.build.version},
                                     {"commit", context.build.commit},
                                     {"build", context.build.build}};
  router.add("GET", "/healthz", Access::open,
             [alive](const RequestPtr&, const Reply& reply) { reply(uncached(json_answer(200, alive))); });
  router.add("GET", "/readyz", Access::open, on_pool(context.health, [&](const Request&) { return ready(context); }));
  router.add("GET", "/metrics", Access::metrics,
             on_pool(context.health, [&](const Request&) { return metrics(context); }));
}

}  // namespace bahnwerk::server
