#include "server/service.hpp"

#include <algorithm>
#include <thread>

#include "api/planned_job.hpp"
#include "server/http/key_gate.hpp"
#include "server/http/middleware.hpp"
#include "server/http/packing.hpp"
#include "server/pages/assets.hpp"
#include "server/routes/examples.hpp"
#include "server/routes/pages/login.hpp"
#include "server/routes/pages/problem_page.hpp"
#include "server/runtime/clock.hpp"
#include "server/runtime/descriptors.hpp"
#include "server/runtime/log.hpp"
#include "server/store/open.hpp"
#include "server/store/store_url.hpp"

namespace bahnwerk::server {
namespace {

/// Checks of posted documents have their own threads: they may take long, and queries of jobs must not wait for them.
constexpr unsigned check_threads = 2;

constexpr unsigned health_threads = 2;

constexpr unsigned callback_threads = 8;  ///< deliveries at a time; one suffices where no host may be called

/// How often changes of other processes are asked for, beside their signals and without these.
constexpr std::chrono::milliseconds poll_beside_signals{1'000}, poll_alone{250};

/// Time after which a silent worker of a shared store loses its jobs to others.
constexpr std::chrono::milliseconds worker_lease{30'000};

/// Descriptors beside connections: the store's files and readers, log, event loops.
constexpr std::size_t other_descriptors = 128;

Limits affordable(Limits limits) {
  const std::size_t more = limits.spare_connections + other_descriptors;
  const std::size_t open = raise_descriptors(2 * limits.max_connections + more);  // those that leave count, too
  if (open >= limits.max_connections + more) return limits;
  const std::size_t most = open > more + 16 ? open - more : 16;
  log::warn("max_connections_lowered", {{"from", limits.max_connections}, {"to", most}, {"descriptors", open}});
  limits.max_connections = most;
  return limits;
}

}  // namespace

Engine real_engine() { return {api::parse_job, api::plan_job, api::check_job, api::preview_job}; }

Service::Service(const ServiceOptions& options, Engine engine, const TimeSource& time)
    : options_(options), time_(time), notifier_(time), live_(!names_postgres(options.store)) {
  // The address first: whoever cannot have it must not leave a new database behind. Nobody is answered before start().
  const auto offload = [this](std::function<void()> work) { scans_->post(std::move(work)); };
  const Handler handler = compose(
      {request_id(), access_log(options.logged_requests), audit(), count(metrics_), cors(hosts_), pack_answers(offload),
       prefixed(), tell_store_state([this] { return store_->state(); }), problem_pages(), guard(), same_site(hosts_)},
      [this](const RequestPtr& request, const Reply& reply) { router_(request, reply); });
  const unsigned workers = options.role == Role::api ? 0 : options.workers;
  check_origins(options.cors_origins);
  const CallbackHosts callback_hosts(options.callback_hosts);
  listener_ = std::make_unique<Listener>(
      affordable(options.limits), ListenerHooks{.handler = handler,
                                                .offload = offload,
                                                .connections = [this](std::size_t open) { metrics_.connections(open); },
                                                .proxies = TrustedProxies(options.trusted_proxies)});
  check_store(options.store);
  if (options.role != Role::all && !names_postgres(options.store))
    throw std::runtime_error("--role " + std::string(role_name(options.role)) +
                             " needs a store that processes share, postgresql://…; a SQLite file is owned by one "
                             "process (use --role all)");
  std::vector<api::MachineFile> machines = offered_machines(options.machines);
  listener_->open(options.listen, options.tls, options.socket_mode);
  const bool keys_required = !options.insecure_listen && listener_->reachable();
  if (keys_required) demand_keys(options);
  hosts_ = allowed_hosts(options.listen, listener_->address(), options.allowed_hosts);
  hosts_.origins = options.cors_origins;
  SharedStoreOptions shared = options.shared_store;
  shared.lost = [this](const std::vector<std::string>& jobs) {
    metrics_.lost(jobs.size());
    for (const std::string& id : jobs) log::warn("attempt_lost", {{"job", id}});
  };
  store_ = open_store(
      options.store, [this](double seconds, std::size_t writes) { metrics_.commit(seconds, writes); },
      options.store_reserve, options.retention, shared);
  pool_ = std::make_unique<Pool>(std::max(4U, std::thread::hardware_concurrency()));
  scans_ = std::make_unique<Pool>(std::max(4U, std::thread::hardware_concurrency()));
  health_ = std::make_unique<Pool>(health_threads);
  checks_ = std::make_unique<Pool>(check_threads);
  heavy_ = std::make_unique<Pool>(1, options.worker_nice);
  // The owner of a file needs no clock to detect that a worker has ended: it would have ended itself.
  WorkersOptions working{.time = time_, .check = std::move(engine.check)};
  if (store_->shared()) working.lease = worker_lease;
  workers_ = std::make_unique<Workers>(*store_, live_, notifier_, metrics_, std::move(engine.plan), std::move(working));
  workers_->limit_planning(options.max_planning);
  metrics_.started(time_.now_ms());
  deadlines_ = std::make_unique<Deadlines>(*store_, time_, [this](const Expired& expired) {
    metrics_.lost(expired.lost.size());
    const std::int64_t now = time_.now_ms();
    if (!expired.next || *expired.next > now) metrics_.caught_up(now);
  });
  callbacks_ = std::make_unique<Callbacks>(*store_, metrics_, http_sender(callback_hosts),
                                           callback_hosts.empty() ? 1 : callback_threads, time_);
  running_ = std::make_unique<RunningJobs>(*store_, live_, notifier_, time_);
  follow_changes();
  metrics_.build(options.build.version, options.build.commit);
  places_ = std::make_unique<QueuePlaces>(*store_, time_);
  context_ = std::make_unique<Context>(Context{*store_,
                                               live_,
                                               notifier_,
                                               *pool_,
                                               *scans_,
                                               *health_,
                                               *checks_,
                                               *heavy_,
                                               metrics_,
                                               std::move(engine.parse),
                                               std::move(engine.preview),
                                               std::move(machines),
                                               options.max_queued,
                                               options.max_planning,
                                               options.limits.max_body,
                                               draining_,
                                               options.build,
                                               time_,
                                               options.event_heartbeat,
                                               workers,
                                               callback_hosts,
                                               *places_,
                                               *running_});
  add_health_routes(router_, *context_);
  if (options.role != Role::worker) {
    add_job_routes(router_, *context_);
    add_result_routes(router_, *context_);
    add_limits_routes(router_, *context_);
    add_meta_routes(router_, *context_);
    add_path_routes(router_, *context_);
    add_scene_routes(router_, *context_);
    add_example_routes(router_, *context_);
    add_page_routes(router_, *context_);
    add_asset_routes(router_);
  }
  keys_ = std::make_unique<KeyRing>(
      *store_, [this] { notifier_.all_changed(); }, std::chrono::milliseconds(250), keys_required);
  if (options.role != Role::worker) add_login_routes(router_, *keys_);
  gate_ = std::make_unique<KeyGate>(*keys_, *store_, *pool_, login_page);
  router_.guard(*gate_);
  listener_->start(options.http_threads);
  workers_->start(workers, options.worker_nice);
}

Service::~Service() {
  draining_ = true;
  workers_->stop_claiming();
  workers_->interrupt();
  stop_listening(options_.answer_patience);
  feed_.reset();
  // No request arrives from here on: work in progress ends from the top to the bottom.
  workers_.reset();
  checks_->join();
  heavy_->join();
  scans_->join();
  health_->join();
  pool_->join();
  keys_.reset();
  callbacks_.reset();
  deadlines_.reset();
  running_.reset();
  store_.reset();
}

/// Throws where others could reach the service without a key. A store that is away is asked for keys later.
void Service::demand_keys(const ServiceOptions& options) const {
  try {
    if (!list_keys(options.store, options.shared_store.pooled).empty()) return;
  } catch (const StoreAway&) {
    return;
  }
  throw std::runtime_error(
      listener_->address() +
      " is reached from other machines, and there is no key: whoever reaches it could post, read and delete jobs. Make "
      "one (bahnwerk key add NAME --scope submit,read --store " +
      without_secrets(options.store) +
      "), listen on 127.0.0.1, or, where something else keeps others out, say so with --insecure-listen "
      "(BAHNWERK_INSECURE_LISTEN=true)");
}

void Service::follow_changes() {
  ChangeFeed::Hooks hooks;
  hooks.changed = [this](const std::vector<Changed>& changes) {
    running_->changed();
    std::size_t queued = 0, ended = 0;
    for (const Changed& change : changes) {
      if (change.cancel_requested) live_.cancel(change.id);
      (change.state == api::JobState::queued ? queued : ended) += change.state == api::JobState::running ? 0 : 1;
      notifier_.changed(change.id);
    }
    notifier_.changed(std::string(Notifier::any_job));
    // A job that has to run alone begins when others have ended, and others when it has.
    if (queued + ended > 0) workers_->notify(queued + ended);
    if (queued > 0) deadlines_->notify();
    if (ended > 0) callbacks_->notify();
  };
  hooks.all = [this] {
    running_->changed();
    notifier_.all_changed();
    workers_->look_for_cancels();
    workers_->notify(options_.workers);
    deadlines_->notify();
    callbacks_->notify();
  };
  hooks.caught_up = [this] { metrics_.changes_known(time_.now_ms()); };
  feed_ = std::make_unique<ChangeFeed>(*store_, std::move(hooks),
                                       options_.shared_store.hears() ? poll_beside_signals : poll_alone);
}

std::string Service::address() const { return listener_->address(); }

void Service::reload_certificate() {
  try {
    listener_->reload_certificate();
    log::info("certificate_loaded");
  } catch (const std::exception& error) {  // the one in use stays
    log::error("certificate_not_loaded", {{"detail", error.what()}});
  }
}

void Service::probe(std::function<void()> answered) {
  listener_->post([this, answered = std::move(answered)]() mutable {
    store_->shared() ? answered() : pool_->post(std::move(answered));
  });
}

bool Service::stop_listening(std::chrono::milliseconds patience) {
  notifier_.release();
  const bool answered = listener_->stop(patience);
  if (!answered) log::warn("requests_cut_off");
  return answered;
}

Service::Drained Service::drain() {
  using Clock = std::chrono::steady_clock;
  using std::chrono::milliseconds;
  const auto until = Clock::now() + options_.drain_timeout;
  const auto left = [&](Clock::time_point end) {
    return std::max(milliseconds(0), std::chrono::duration_cast<milliseconds>(end - Clock::now()));
  };
  log::info("drain_started", {{"running", live_.size()}});
  draining_ = true;
  notifier_.release();
  workers_->stop_claiming();
  bool stuck = false;
  if (!workers_->wait_idle(options_.drain_timeout)) {
    log::info("drain_timeout", {{"running", live_.size()}});
    workers_->interrupt();
    if (!workers_->wait_idle(left(until + options_.stop_patience))) {
      log::error("planner_did_not_stop", {{"running", live_.size()}});
      stuck = true;
    }
  }
  callbacks_->stop();
  const bool answered = stop_listening(std::max(left(until), options_.answer_patience));
  // A client that was cut off, or has left, may have left a check behind for which nobody waits.
  const auto rest = std::max(until, Clock::now() + options_.answer_patience / 2);
  const bool idle = checks_->wait_idle(left(rest)) && heavy_->wait_idle(left(rest)) && scans_->wait_idle(left(rest)) &&
                    health_->wait_idle(left(rest)) && pool_->wait_idle(left(rest)) && callbacks_->wait_idle(left(rest));
  // A planner that gets no processor time cannot put its job back; whatever it still does comes too late then.
  if (stuck) try {
      for (const auto& live : live_.all()) store_->requeue(live->attempt(), now_ms(), live->revision());
    } catch (const StoreError& error) {
      log::error("requeue_failed", {{"detail", error.what()}});
    }
  log::info("drain_finished", {{"requests_cut_off", !answered}});
  return stuck ? Drained::stuck : idle ? Drained::clean : Drained::late;
}

}  // namespace bahnwerk::server
