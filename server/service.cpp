#include "server/service.hpp"

#include <algorithm>
#include <thread>

#include "server/http/middleware.hpp"
#include "server/runtime/log.hpp"
#include "server/store/open.hpp"

namespace bahnwerk::server {
namespace {

/// After the drain timeout a planner has this long to notice (its rule: 100 ms) and its job to be put back.
constexpr std::chrono::seconds stop_patience{5};
constexpr std::chrono::seconds answer_patience{5};

}  // namespace

Engine real_engine() { return {api::parse_job, api::plan_job}; }

Service::Service(const ServiceOptions& options, Engine engine) : options_(options) {
  // The address first: whoever cannot have it must not leave a new database behind. Nobody is answered before start().
  const Handler handler = compose({request_id(), access_log(), count(metrics_), guard()},
                                  [this](const RequestPtr& request, const Reply& reply) { router_(request, reply); });
  listener_ = std::make_unique<Listener>(
      options.limits, ListenerHooks{.handler = handler,
                                    .offload = [this](std::function<void()> work) { pool_->post(std::move(work)); },
                                    .connections = [this](std::size_t open) { metrics_.connections(open); }});
  check_store(options.store);
  listener_->open(options.listen);
  store_ = open_store(options.store, [this](double seconds, std::size_t writes) { metrics_.commit(seconds, writes); });
  pool_ = std::make_unique<Pool>(std::max(4U, std::thread::hardware_concurrency()));
  heavy_ = std::make_unique<Pool>(1);
  workers_ = std::make_unique<Workers>(*store_, live_, notifier_, metrics_, std::move(engine.plan));
  deadlines_ = std::make_unique<Deadlines>(*store_, notifier_);
  context_ = std::make_unique<Context>(Context{*store_, *workers_, live_, notifier_, *deadlines_, *pool_, *heavy_,
                                               metrics_, std::move(engine.parse), options.max_queued,
                                               options.limits.max_body, draining_});
  add_job_routes(router_, *context_);
  add_result_routes(router_, *context_);
  add_meta_routes(router_, *context_);
  add_health_routes(router_, *context_);
  add_page_routes(router_, *context_);
  listener_->start(options.http_threads);
  workers_->start(options.workers);
}

Service::~Service() {
  draining_ = true;
  workers_->stop_claiming();
  workers_->interrupt();
  stop_listening();
  // From here on nobody asks any more: let what is under way end from the top to the bottom.
  workers_.reset();
  heavy_->join();
  pool_->join();
  deadlines_.reset();
  store_.reset();
}

std::string Service::address() const { return listener_->address(); }

void Service::stop_listening() {
  notifier_.release();
  if (!listener_->stop(answer_patience)) log::warn("requests_cut_off");
}

bool Service::drain() {
  log::info("drain_started", {{"running", live_.size()}});
  draining_ = true;
  notifier_.release();
  workers_->stop_claiming();
  if (!workers_->wait_idle(options_.drain_timeout)) {
    log::info("drain_timeout", {{"running", live_.size()}});
    workers_->interrupt();
    if (!workers_->wait_idle(stop_patience)) {
      log::error("planner_did_not_stop", {{"running", live_.size()}});
      return false;
    }
  }
  stop_listening();
  try {
    store_->checkpoint();
  } catch (const StoreError& error) {
    log::error("checkpoint_failed", {{"detail", error.what()}});
  }
  log::info("drain_finished");
  return true;
}

}  // namespace bahnwerk::server
