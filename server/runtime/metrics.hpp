#pragma once
/// Counters of the service in Prometheus' terms.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace bahnwerk::server {

class Metrics {
 public:
  Metrics();
  ~Metrics();
  Metrics(const Metrics&) = delete;
  Metrics& operator=(const Metrics&) = delete;

  void request(std::string_view route, std::string_view method, int status, double seconds, bool waited = false);
  void refused(std::string_view problem);
  void planned(std::string_view kind, std::string_view state, double seconds);
  void commit(double seconds, std::size_t writes);  ///< counts a transaction of the store
  void rows_read(std::size_t rows);                 ///< counts stored setpoints that were unpacked for an answer
  void callback(std::string_view outcome);          ///< counts an attempt: delivered, failed, given_up
  void connections(std::size_t open);
  void jobs(std::string_view state, std::size_t count);
  void lost(std::size_t attempts);      ///< counts attempts whose worker gave no sign of life any more
  void caught_up(std::int64_t now_ms);  ///< nothing is due that deadlines, leases and retention end
  void started(std::int64_t now_ms);
  void build(const std::string& version, const std::string& commit);
  /// What is looked at when somebody asks.
  struct Observed {
    double resident_bytes = 0, max_memory_bytes = 0, descriptors = 0, max_descriptors = 0, workers = 0,
           busy_workers = 0;
    double oldest_queued_seconds = 0, store_bytes = 0, store_log_bytes = 0, store_free_bytes = 0;
    double callbacks = 0, beyond_engine = 0;
  };
  void observe(const Observed& observed);
  std::string text() const;  ///< Prometheus text format 0.0.4

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bahnwerk::server
