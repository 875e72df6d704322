#include "server/runtime/metrics.hpp"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

namespace bahnwerk::server {
namespace {

using Buckets = prometheus::Histogram::BucketBoundaries;
const Buckets request_buckets{0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 60};
const Buckets planning_buckets{0.001, 0.005, 0.01, 0.05, 0.1, 0.5, 1, 5, 10, 30, 60, 300, 1800};
const Buckets commit_buckets{0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.5, 1, 5};

}  // namespace

struct Metrics::State {
  prometheus::Registry registry;
  prometheus::Family<prometheus::Counter>& requests = prometheus::BuildCounter()
                                                          .Name("bahnwerk_http_requests_total")
                                                          .Help("HTTP requests answered, by route, method and status")
                                                          .Register(registry);
  prometheus::Family<prometheus::Histogram>& latency =
      prometheus::BuildHistogram()
          .Name("bahnwerk_http_request_seconds")
          .Help("From the request's last byte to the answer's first, s")
          .Register(registry);
  prometheus::Family<prometheus::Histogram>& waits =
      prometheus::BuildHistogram()
          .Name("bahnwerk_http_wait_seconds")
          .Help("The same for requests that were told to wait for something to happen, s")
          .Register(registry);
  prometheus::Family<prometheus::Counter>& refusals = prometheus::BuildCounter()
                                                          .Name("bahnwerk_refusals_total")
                                                          .Help("Requests answered with a problem, by its type")
                                                          .Register(registry);
  prometheus::Family<prometheus::Gauge>& builds =
      prometheus::BuildGauge().Name("bahnwerk_build_info").Help("The program that runs").Register(registry);
  prometheus::Gauge& gauge(const char* name, const char* help) {
    return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add({});
  }
  prometheus::Gauge& resident = gauge("process_resident_memory_bytes", "Resident memory, bytes");
  prometheus::Gauge& max_memory =
      gauge("bahnwerk_max_memory_bytes", "Memory that the process may use, bytes; 0: no limit");
  prometheus::Gauge& start = gauge("process_start_time_seconds", "Start of the process, s since 1970 UTC");
  prometheus::Gauge& caught_up = gauge("bahnwerk_retention_caught_up_timestamp_seconds",
                                       "Last time that no deadline, lease or retention was due, s since 1970 UTC");
  prometheus::Counter& lost = prometheus::BuildCounter()
                                  .Name("bahnwerk_attempts_lost_total")
                                  .Help("Attempts whose worker gave no sign of life any more")
                                  .Register(registry)
                                  .Add({});
  prometheus::Gauge& descriptors = gauge("process_open_fds", "Open files and sockets");
  prometheus::Gauge& max_descriptors = gauge("process_max_fds", "Files and sockets that may be open");
  prometheus::Gauge& workers = gauge("bahnwerk_workers", "Planner threads");
  prometheus::Gauge& busy = gauge("bahnwerk_workers_busy", "Planner threads that plan a job");
  prometheus::Gauge& oldest = gauge("bahnwerk_queue_oldest_seconds", "Age of the job that waits longest, s");
  prometheus::Gauge& beyond =
      gauge("bahnwerk_queue_beyond_engine", "Jobs in the queue that need a later planner than this process has");
  prometheus::Gauge& changes_known =
      gauge("bahnwerk_feed_caught_up_timestamp_seconds",
            "Last time that all changes of other processes were known, s since 1970 UTC; NaN: there are no others");
  prometheus::Gauge& store = gauge("bahnwerk_store_bytes", "Size of the store's file or database, bytes");
  prometheus::Gauge& store_log = gauge("bahnwerk_store_log_bytes", "Size of the store's log, bytes");
  prometheus::Gauge& store_free = gauge("bahnwerk_store_free_bytes", "Bytes free on the store's disk");
  prometheus::Family<prometheus::Gauge>& store_states =
      prometheus::BuildGauge()
          .Name("bahnwerk_store_state")
          .Help("1 for what can be done with the store: up, read_only, away; 0 for the others")
          .Register(registry);
  prometheus::Family<prometheus::Gauge>& connections =
      prometheus::BuildGauge()
          .Name("bahnwerk_store_connections")
          .Help("Connections to the store's server that requests and plans share, by use: busy, idle")
          .Register(registry);
  prometheus::Gauge& max_connections =
      gauge("bahnwerk_store_connections_max", "Largest number of these connections; 0: the store has no server");
  prometheus::Gauge& dead_rows = gauge("bahnwerk_store_dead_rows", "Deleted rows of the queue not yet freed");
  prometheus::Gauge& snapshot_seconds =
      gauge("bahnwerk_store_snapshot_seconds", "Age of the oldest snapshot of the store, s");
  prometheus::Gauge& snapshot_transactions =
      gauge("bahnwerk_store_snapshot_transactions", "Age of the oldest snapshot of the store, transactions");
  prometheus::Gauge& callbacks = gauge("bahnwerk_callbacks_pending", "Callbacks of ended jobs that wait for delivery");
  prometheus::Family<prometheus::Counter>& callback_attempts = prometheus::BuildCounter()
                                                                   .Name("bahnwerk_callback_attempts_total")
                                                                   .Help("Calls of receivers, by their outcome")
                                                                   .Register(registry);
  prometheus::Family<prometheus::Histogram>& planning = prometheus::BuildHistogram()
                                                            .Name("bahnwerk_planning_seconds")
                                                            .Help("Planning time of jobs by kind and final state, s")
                                                            .Register(registry);
  prometheus::Histogram& claims = prometheus::BuildHistogram()
                                      .Name("bahnwerk_claim_seconds")
                                      .Help("From asking the store for a job to having it, where there was one, s")
                                      .Register(registry)
                                      .Add({}, commit_buckets);
  prometheus::Histogram& commits = prometheus::BuildHistogram()
                                       .Name("bahnwerk_store_commit_seconds")
                                       .Help("Durable store transactions, s")
                                       .Register(registry)
                                       .Add({}, commit_buckets);
  prometheus::Counter& writes = prometheus::BuildCounter()
                                    .Name("bahnwerk_store_writes_total")
                                    .Help("Writes committed; divided by the commits it is the size of a group")
                                    .Register(registry)
                                    .Add({});
  prometheus::Counter& rows_read = prometheus::BuildCounter()
                                       .Name("bahnwerk_setpoint_rows_read_total")
                                       .Help("Rows of stored setpoints unpacked for answers, whole chunks")
                                       .Register(registry)
                                       .Add({});
  prometheus::Family<prometheus::Gauge>& job_states =
      prometheus::BuildGauge().Name("bahnwerk_jobs").Help("Jobs in the store by state").Register(registry);
  prometheus::Gauge& queue = prometheus::BuildGauge()
                                 .Name("bahnwerk_queue_length")
                                 .Help("Jobs waiting for a worker")
                                 .Register(registry)
                                 .Add({});
  prometheus::Gauge& open =
      prometheus::BuildGauge().Name("bahnwerk_http_connections").Help("Open connections").Register(registry).Add({});
};

Metrics::Metrics() : state_(std::make_unique<State>()) {
  state_->changes_known.Set(unknown);
  for (const char* const outcome : {"delivered", "failed", "given_up"})
    state_->callback_attempts.Add({{"outcome", outcome}});
}
Metrics::~Metrics() = default;

void Metrics::request(std::string_view route, std::string_view method, int status, double seconds, bool waited) {
  state_->requests
      .Add({{"route", std::string(route)}, {"method", std::string(method)}, {"status", std::to_string(status)}})
      .Increment();
  (waited ? state_->waits : state_->latency)
      .Add({{"route", std::string(route)}, {"method", std::string(method)}}, request_buckets)
      .Observe(seconds);
}

void Metrics::refused(std::string_view problem) {
  state_->refusals.Add({{"reason", std::string(problem)}}).Increment();
}

void Metrics::build(const std::string& version, const std::string& commit) {
  state_->builds.Add({{"version", version}, {"commit", commit}}).Set(1);
}

void Metrics::lost(std::size_t attempts) { state_->lost.Increment(static_cast<double>(attempts)); }

void Metrics::caught_up(std::int64_t now_ms) { state_->caught_up.Set(static_cast<double>(now_ms) * 1e-3); }

void Metrics::changes_known(std::int64_t now_ms) { state_->changes_known.Set(static_cast<double>(now_ms) * 1e-3); }

void Metrics::store_state(std::string_view state) {
  for (const std::string_view each : {"up", "read_only", "away"})
    state_->store_states.Add({{"state", std::string(each)}}).Set(each == state ? 1 : 0);
}

void Metrics::started(std::int64_t now_ms) { state_->start.Set(static_cast<double>(now_ms) * 1e-3); }

void Metrics::observe(const Observed& observed) {
  state_->resident.Set(observed.resident_bytes);
  state_->max_memory.Set(observed.max_memory_bytes);
  state_->descriptors.Set(observed.descriptors);
  state_->max_descriptors.Set(observed.max_descriptors);
  state_->workers.Set(observed.workers);
  state_->busy.Set(observed.busy_workers);
  state_->connections.Add({{"use", "busy"}}).Set(observed.busy_connections);
  state_->connections.Add({{"use", "idle"}}).Set(observed.idle_connections);
  state_->max_connections.Set(observed.max_connections);
  state_->oldest.Set(observed.oldest_queued_seconds);
  state_->beyond.Set(observed.beyond_engine);
  state_->dead_rows.Set(observed.dead_rows);
  state_->snapshot_seconds.Set(observed.snapshot_seconds);
  state_->snapshot_transactions.Set(observed.snapshot_transactions);
  state_->store.Set(observed.store_bytes);
  state_->store_log.Set(observed.store_log_bytes);
  state_->store_free.Set(observed.store_free_bytes);
  state_->callbacks.Set(observed.callbacks);
}

void Metrics::planned(std::string_view kind, std::string_view state, double seconds) {
  state_->planning.Add({{"kind", std::string(kind)}, {"state", std::string(state)}}, planning_buckets).Observe(seconds);
}

void Metrics::claimed(double seconds) { state_->claims.Observe(seconds); }

void Metrics::commit(double seconds, std::size_t writes) {
  state_->commits.Observe(seconds);
  state_->writes.Increment(static_cast<double>(writes));
}

void Metrics::rows_read(std::size_t rows) { state_->rows_read.Increment(static_cast<double>(rows)); }

void Metrics::callback(std::string_view outcome) {
  state_->callback_attempts.Add({{"outcome", std::string(outcome)}}).Increment();
}

void Metrics::connections(std::size_t open) { state_->open.Set(static_cast<double>(open)); }

void Metrics::jobs(std::string_view state, double count) {
  state_->job_states.Add({{"state", std::string(state)}}).Set(count);
  if (state == "queued") state_->queue.Set(count);
}

std::string Metrics::text() const { return prometheus::TextSerializer().Serialize(state_->registry.Collect()); }

}  // namespace bahnwerk::server
