#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <ctime>
#include <iostream>

#include "server/cli/cli.hpp"
#include "server/runtime/log.hpp"
#include "server/runtime/memory.hpp"
#include "server/runtime/supervisor.hpp"
#include "server/store/store_url.hpp"

namespace bahnwerk::server::cli {
namespace {

/// Time for what ends after the drain timeout, at most: the last second of the service, and the store's checkpoint.
constexpr std::chrono::seconds end_allowance{10};

const char* or_empty(const char* text) { return text ? text : ""; }

timespec to_timespec(std::chrono::milliseconds time) {
  return {.tv_sec = time.count() / 1000, .tv_nsec = time.count() % 1000 * 1'000'000};
}

/// Waits for one of these signals and returns it; SIGHUP has the certificate read again. Meanwhile each heartbeat asks
/// the service for a sign of life, which the manager gets only when the service's threads turn.
int wait_for_signal(const sigset_t& ends, const Supervisor& supervisor, Service& service) {
  int received = 0;
  const auto heartbeat = supervisor.heartbeat();
  if (!heartbeat) {
    while (sigwait(&ends, &received) != 0 || received == SIGHUP)
      if (received == SIGHUP) service.reload_certificate();
    return received;
  }
  const timespec interval = to_timespec(*heartbeat);
  do {
    service.probe([&supervisor] { supervisor.alive(); });
    received = sigtimedwait(&ends, nullptr, &interval);
    if (received == SIGHUP) service.reload_certificate();
  } while (received < 0 || received == SIGHUP);
  return received;
}

}  // namespace

int serve(ServiceOptions options) {
  log::info("starting", {{"version", options.build.version},
                         {"commit", options.build.commit},
                         {"build", options.build.build},
                         {"max_memory", options.max_memory},
                         {"pid", ::getpid()}});
  if (options.max_memory > 0 && !limit_memory(options.max_memory))
    log::warn("memory_not_limited", {{"max_memory", options.max_memory}});
  // Blocked before any thread starts, so that only this one takes them.
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGTERM);
  sigaddset(&ends, SIGINT);
  if (!options.tls.certificate.empty()) sigaddset(&ends, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  signal(SIGPIPE, SIG_IGN);

  const Supervisor supervisor(or_empty(std::getenv("NOTIFY_SOCKET")),
                              watchdog_interval(std::getenv("WATCHDOG_USEC"), std::getenv("WATCHDOG_PID"), ::getpid()));
  std::atomic<bool> refused{false};
  options.shared_store.planned_by = options.build.version;
  options.shared_store.refused = [&refused](const std::string& why) {
    if (refused.exchange(true)) return;
    std::cerr << "bahnwerk: " << why << '\n';
    ::kill(::getpid(), SIGTERM);
  };
  std::unique_ptr<Service> service;
  try {
    service = std::make_unique<Service>(options, real_engine());
  } catch (const StoreError& error) {
    std::cerr << "bahnwerk: " << error.what() << '\n';
    return exit_usage;
  } catch (const std::runtime_error& error) {
    std::cerr << "bahnwerk: " << error.what() << '\n';
    return exit_usage;
  }
  log::info("listening", {{"address", service->address()},
                          {"store", without_secrets(options.store)},
                          {"role", std::string(role_name(options.role))},
                          {"workers", options.workers},
                          {"version", options.build.version},
                          {"pid", ::getpid()}});
  supervisor.ready("serving on " + service->address());
  const int received = wait_for_signal(ends, supervisor, *service);
  log::info("signal", {{"signal", received == SIGTERM ? "SIGTERM" : "SIGINT"}});
  supervisor.stopping("draining", options.drain_timeout + end_allowance);
  // A second signal takes its default course: the process ends at once.
  pthread_sigmask(SIG_UNBLOCK, &ends, nullptr);
  const auto drained = service->drain();
  if (refused) ::_exit(exit_usage);
  if (drained != Service::Drained::clean) ::_exit(drained == Service::Drained::stuck ? exit_failed : exit_ok);
  service.reset();
  return exit_ok;
}

}  // namespace bahnwerk::server::cli
