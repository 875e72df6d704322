#pragma once
/// Counters of the service in Prometheus' terms.
#include <cstddef>
#include <cstdint>
#include <limits>
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
  void claimed(double seconds);  ///< counts a job that the store gave to a worker of this process
  void jobs(std::string_view state, double count);
  void lost(std::size_t attempts);           ///< counts attempts whose worker gave no sign of life any more
  void caught_up(std::int64_t now_ms);       ///< nothing is due that deadlines, leases and retention end
  void changes_known(std::int64_t now_ms);   ///< all changes of other processes are known
  void store_state(std::string_view state);  ///< up, read_only or away
  void started(std::int64_t now_ms);
  void build(const std::string& version, const std::string& commit);
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  /// What is looked at when somebody asks. What the store tells is unknown while it does not answer.
  struct Observed {
    double resident_bytes = 0, max_memory_bytes = 0, descriptors = 0, max_descriptors = 0, workers = 0,
           busy_workers = 0;
    double busy_connections = 0, idle_connections = 0, max_connections = 0;  ///< to the store's server
    double oldest_queued_seconds = unknown, beyond_engine = unknown, callbacks = unknown;
    double store_bytes = unknown, store_log_bytes = unknown, store_free_bytes = unknown;
    double dead_rows = unknown, snapshot_seconds = unknown, snapshot_transactions = unknown;
  };
  void observe(const Observed& observed);
  std::string text() const;  ///< Prometheus text format 0.0.4

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bahnwerk::server
