#include "server/runtime/metrics.hpp"

#include <gmock/gmock.h>

namespace bahnwerk::server {
namespace {

using testing::HasSubstr;

TEST(Metrics, CountWhatTheyAreTold) {
  Metrics metrics;
  metrics.request("/v1/jobs/{id}", "GET", 200, 0.002);
  metrics.request("/v1/jobs/{id}", "GET", 200, 0.004);
  metrics.request("/v1/jobs/{id}", "GET", 404, 0.001);
  metrics.planned("contour", "succeeded", 2);
  metrics.commit(0.003, 7);
  metrics.rows_read(4096);
  metrics.jobs("queued", 5);
  metrics.request("/v1/jobs/{id}", "GET", 200, 30, true);
  metrics.refused("too-many-jobs");
  metrics.build("1.2.3", "abc");
  metrics.lost(2);
  metrics.started(1'500);
  metrics.caught_up(2'500);
  metrics.changes_known(3'500);
  metrics.claimed(0.002);
  metrics.store_state("away");
  metrics.store_state("read_only");
  metrics.observe({.max_memory_bytes = 1024,
                   .workers = 3,
                   .busy_workers = 2,
                   .busy_connections = 4,
                   .idle_connections = 1,
                   .max_connections = 6,
                   .oldest_queued_seconds = 7,
                   .beyond_engine = 8,
                   .store_log_bytes = 4096,
                   .dead_rows = 9,
                   .snapshot_seconds = 10,
                   .snapshot_transactions = 11});
  const std::string text = metrics.text();
  EXPECT_THAT(text,
              HasSubstr("bahnwerk_http_requests_total{method=\"GET\",route=\"/v1/jobs/{id}\",status=\"200\"} 3\n"));
  EXPECT_THAT(text,
              HasSubstr("bahnwerk_http_requests_total{method=\"GET\",route=\"/v1/jobs/{id}\",status=\"404\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_http_request_seconds_count{method=\"GET\",route=\"/v1/jobs/{id}\"} 3\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_http_wait_seconds_count{method=\"GET\",route=\"/v1/jobs/{id}\"} 1\n"))
      << "what was told to wait is counted apart";
  EXPECT_THAT(text, HasSubstr("bahnwerk_refusals_total{reason=\"too-many-jobs\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_build_info{commit=\"abc\",version=\"1.2.3\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_attempts_lost_total 2\n"));
  EXPECT_THAT(text, HasSubstr("process_start_time_seconds 1.5\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_retention_caught_up_timestamp_seconds 2.5\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_max_memory_bytes 1024\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_workers_busy 2\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_queue_oldest_seconds 7\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_log_bytes 4096\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_queue_beyond_engine 8\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_claim_seconds_count 1\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_feed_caught_up_timestamp_seconds 3.5\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_state{state=\"up\"} 0\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_state{state=\"read_only\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_state{state=\"away\"} 0\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_connections{use=\"busy\"} 4\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_connections{use=\"idle\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_connections_max 6\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_dead_rows 9\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_snapshot_seconds 10\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_snapshot_transactions 11\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_planning_seconds_sum{kind=\"contour\",state=\"succeeded\"} 2\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_commit_seconds_count 1\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_store_writes_total 7\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_setpoint_rows_read_total 4096\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_jobs{state=\"queued\"} 5\n"));
  EXPECT_THAT(text, HasSubstr("bahnwerk_queue_length 5\n"));
}

TEST(Metrics, WhatTheStoreDoesNotTellIsNoNumber) {
  Metrics metrics;
  EXPECT_THAT(metrics.text(), HasSubstr("bahnwerk_feed_caught_up_timestamp_seconds Nan\n")) << "nobody else changes it";
  metrics.observe({.workers = 1});
  EXPECT_THAT(metrics.text(), HasSubstr("bahnwerk_store_bytes Nan\n"));
}

}  // namespace
}  // namespace bahnwerk::server
