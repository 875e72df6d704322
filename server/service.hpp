#pragma once
/// The whole service: store, workers and listener, with orderly start and end.
#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/callbacks/callbacks.hpp"
#include "server/http/listener.hpp"
#include "server/http/middleware.hpp"
#include "server/http/router.hpp"
#include "server/http/same_site.hpp"
#include "server/jobs/change_feed.hpp"
#include "server/jobs/deadlines.hpp"
#include "server/jobs/workers.hpp"
#include "server/keys/key_ring.hpp"
#include "server/routes/context.hpp"
#include "server/runtime/build_info.hpp"
#include "server/store/open.hpp"

namespace bahnwerk::server {

/// What a process does of the service. Only a shared store serves `api` and `worker`.
enum class Role { all, api, worker };
inline std::string_view role_name(Role role) {
  return role == Role::all ? "all" : role == Role::api ? "api" : "worker";
}

struct ServiceOptions {
  std::string listen = "127.0.0.1:8080";
  std::string store = "sqlite:var/bahnwerk.db";
  Role role = Role::all;            ///< api: plans nothing; worker: answers /healthz, /readyz and /metrics alone
  SharedStoreOptions shared_store;  ///< for a store that processes share
  std::size_t store_reserve = std::size_t{8} << 20;  ///< bytes of disk set aside, so that a full disk can be emptied
  Retention retention;                               ///< how long ended jobs are kept
  std::size_t max_memory = 0;                        ///< bytes of the whole process, set when it starts; 0: no limit
  int worker_nice = 10;  ///< difference of the planners' priority to that of the answering threads
  unsigned workers = 1;  ///< planner threads; 0 = accepts jobs without planning them
  unsigned http_threads = 2;
  std::size_t max_queued = 10'000;
  std::vector<std::string> allowed_hosts;    ///< names by which clients ask for it; see allowed_hosts()
  std::vector<std::string> cors_origins;     ///< sites whose pages may use it
  std::vector<std::string> trusted_proxies;  ///< see TrustedProxies
  std::vector<std::string> callback_hosts;   ///< see CallbackHosts
  TlsFiles tls;
  unsigned socket_mode = 0660;                      ///< permissions of a Unix socket
  bool insecure_listen = false;                     ///< listen beyond this machine without keys
  std::string machines;                             ///< folder with machines of the plant; empty: none
  std::chrono::milliseconds max_planning{600'000};  ///< time of a plan; then it ends as budget-exhausted
  Limits limits;
  std::chrono::milliseconds event_heartbeat{15'000};  ///< longest silence of a stream of events
  std::chrono::milliseconds drain_timeout{10'000};    ///< time for running jobs after the end was requested
  /// After the drain timeout a planner has this long to notice (its rule: 100 ms of its processor time) and its job to
  /// be requeued; then requests have the rest of the second until the end.
  std::chrono::milliseconds stop_patience{700}, answer_patience{200};
  LoggedRequests logged_requests = LoggedRequests::all;
  BuildInfo build;
};

/// The functions that check and plan documents; the real ones are those of api/.
struct Engine {
  Parser parse;
  Planner plan;
  Checker check = {};  ///< none: no check is stopped
  Previewer preview = {};
};
Engine real_engine();

class Service {
 public:
  /// Opens store and port, recovers, and serves. Throws std::runtime_error (StoreError included) with a sentence for
  /// the operator.
  Service(const ServiceOptions& options, Engine engine, const TimeSource& time = system_time());
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  std::string address() const;  ///< HOST:PORT as bound, or unix:PATH
  void reload_certificate();    ///< reads the TLS files again, for new connections; logs what is wrong with them
  std::vector<Router::Entry> routes() const { return router_.entries(); }
  /// Calls `answered` after a socket thread and then a thread that reads the store have run it. If threads of either
  /// type are stuck, it is never called. Threads that read a shared store may wait for its server: they are left out.
  void probe(std::function<void()> answered);
  /// Ends orderly: new jobs are refused, running ones may finish within the drain timeout and return to the queue
  /// otherwise, requests in flight are answered within that time, too, and the store is checkpointed. It takes at most
  /// the drain timeout, both patiences and 100 ms. clean: all threads are at rest; late: some request is not;
  /// stuck: some planner is not, its work is lost and its job is back in the queue. Only _exit is safe unless clean.
  enum class Drained { clean, late, stuck };
  Drained drain();

 private:
  void follow_changes();
  void demand_keys(const ServiceOptions& options) const;
  bool stop_listening(std::chrono::milliseconds patience);
  ServiceOptions options_;
  std::atomic<bool> draining_{false};
  const TimeSource& time_;
  Metrics metrics_;
  std::unique_ptr<Store> store_;
  AllowedHosts hosts_;
  Router router_;
  std::unique_ptr<Gate> gate_;
  Notifier notifier_;
  LiveJobs live_;
  std::unique_ptr<Listener> listener_;  ///< sockets outlive the members below
  std::unique_ptr<Pool> pool_, scans_, health_, checks_, heavy_;
  std::unique_ptr<Workers> workers_;
  std::unique_ptr<Deadlines> deadlines_;
  std::unique_ptr<Callbacks> callbacks_;
  std::unique_ptr<ChangeFeed> feed_;
  std::unique_ptr<KeyRing> keys_;
  std::unique_ptr<QueuePlaces> places_;
  std::unique_ptr<RunningJobs> running_;
  std::unique_ptr<Context> context_;
};

}  // namespace bahnwerk::server
