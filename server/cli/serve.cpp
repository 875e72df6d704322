#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <iostream>

#include "server/cli/cli.hpp"
#include "server/runtime/log.hpp"

namespace bahnwerk::server::cli {

int serve(const ServiceOptions& options) {
  // Blocked before any thread starts, so that only this one takes them.
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGTERM);
  sigaddset(&ends, SIGINT);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  signal(SIGPIPE, SIG_IGN);

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
                          {"store", options.store},
                          {"workers", options.workers},
                          {"version", BAHNWERK_VERSION},
                          {"pid", ::getpid()}});
  int received = 0;
  sigwait(&ends, &received);
  log::info("signal", {{"signal", received == SIGTERM ? "SIGTERM" : "SIGINT"}});
  // A second signal takes its default course: the process ends at once.
  pthread_sigmask(SIG_UNBLOCK, &ends, nullptr);
  if (service->drain() == Service::Drained::late) ::_exit(exit_ok);
  service.reset();
  return exit_ok;
}

}  // namespace bahnwerk::server::cli
