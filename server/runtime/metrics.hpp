#pragma once
/// Counters of the service in Prometheus' terms.
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

  void request(std::string_view route, std::string_view method, int status, double seconds);
  void planned(std::string_view kind, std::string_view state, double seconds);
  void commit(double seconds, std::size_t writes);  ///< counts a transaction of the store
  void connections(std::size_t open);
  void jobs(std::string_view state, std::size_t count);
  std::string text() const;  ///< Prometheus text format 0.0.4

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bahnwerk::server
