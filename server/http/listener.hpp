#pragma once
/// The HTTP/1.1 server: sockets in, Requests out to a handler, Responses back. Beast and Asio stay behind this header.
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "server/http/message.hpp"

namespace bahnwerk::server {

struct Limits {
  std::size_t max_body = std::size_t{64} << 20;      ///< bytes; larger requests are answered 413
  std::size_t max_bodies = std::size_t{256} << 20;   ///< bytes of all bodies in hand; further ones are answered 503
  std::size_t max_header = 32 << 10;                 ///< bytes; 431
  std::size_t max_connections = 1024;                ///< then the one that has been idle longest makes room
  std::size_t max_per_address = 512;                 ///< the same for one address (IPv6: one /64); 0 = no such limit
  std::size_t spare_connections = 32;                ///< beyond the limit, for /healthz and /readyz alone
  std::chrono::milliseconds header_timeout{10'000};  ///< for the header: from connecting, later from its first byte
  std::chrono::milliseconds body_timeout{30'000};    ///< for the body, plus 1 s per 100 kB received
  std::chrono::milliseconds stall_timeout{5'000};    ///< after it a body that stands still makes room for others
  std::chrono::milliseconds idle_timeout{75'000};    ///< between requests of a connection
  std::chrono::milliseconds write_timeout{30'000};   ///< for each piece of an answer, plus 1 s per 100 kB of it
};

struct ListenerHooks {
  Handler handler;                                     ///< called on the socket threads: must not block
  std::function<void(std::function<void()>)> offload;  ///< runs what may block (pulling streamed bodies) elsewhere
  std::function<void(std::size_t)> connections = [](std::size_t) {};  ///< told how many are open
};

class Listener {
 public:
  Listener(Limits limits, ListenerHooks hooks);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// Binds HOST:PORT ([::1]:8080 for IPv6; port 0 picks a free one). Throws std::runtime_error with a sentence for the
  /// operator.
  void open(const std::string& address);
  std::string address() const;  ///< as bound, "127.0.0.1:8080"
  void start(unsigned threads);
  /// Runs `work`, which must not block, on a socket thread.
  void post(std::function<void()> work);
  /// Orderly end: no new connections, idle ones close, requests in flight are answered, then false if some outlasted
  /// `patience`.
  bool stop(std::chrono::milliseconds patience);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bahnwerk::server
