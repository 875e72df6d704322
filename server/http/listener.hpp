#pragma once
/// The HTTP/1.1 server: it turns connections into Requests for a handler and writes the Responses. Beast and Asio are
/// hidden behind this header.
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "server/http/forwarded.hpp"
#include "server/http/message.hpp"

namespace bahnwerk::server {

struct Limits {
  std::size_t max_body = std::size_t{64} << 20;     ///< bytes; larger ones are answered 413
  std::size_t max_bodies = std::size_t{256} << 20;  ///< bytes of all current bodies; further ones are answered 503
  std::size_t max_header = 32 << 10;                ///< bytes; larger ones are answered 431
  std::size_t max_connections = 1024;               ///< limit of connections; beyond it the longest idle one is closed
  std::size_t max_per_address = 512;                ///< limit for one address (IPv6: one /64); 0 = none
  std::size_t spare_connections = 32;               ///< connections beyond the limit, for /healthz and /readyz only
  std::chrono::milliseconds header_timeout{
      10'000};                                     ///< limit for the header: from connecting, later from its first byte
  std::chrono::milliseconds body_timeout{30'000};  ///< limit for the body, plus 1 s per 100 kB received
  std::chrono::milliseconds stall_timeout{
      5'000};  ///< time after which a body without progress may be closed in favour of others
  std::chrono::milliseconds idle_timeout{75'000};   ///< longest time between requests of a connection
  std::chrono::milliseconds write_timeout{30'000};  ///< limit for each piece of an answer, plus 1 s per 100 kB of it
};

/// Files in PEM form. Without a certificate the service speaks plain HTTP; with `client_ca` it speaks to nobody without
/// a certificate that this authority has signed.
struct TlsFiles {
  std::string certificate, key, client_ca;
};

struct ListenerHooks {
  Handler handler;  ///< handler, called on the socket threads: must not block
  std::function<void(std::function<void()>)>
      offload;  ///< runs blocking work (pulling streamed bodies) on other threads
  std::function<void(std::size_t)> connections = [](std::size_t) {};  ///< receives the number of open connections
  TrustedProxies proxies = {};                                        ///< whose word about their clients counts
};

class Listener {
 public:
  Listener(Limits limits, ListenerHooks hooks);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// Binds HOST:PORT ([::1]:8080 for IPv6; port 0 picks a free one) or unix:PATH, whose socket gets the permissions
  /// `mode`; one that a former process has left is replaced. Throws std::runtime_error with a sentence for the
  /// operator.
  void open(const std::string& address, const TlsFiles& tls = {}, unsigned mode = 0660);
  std::string address() const;  ///< the bound address, "127.0.0.1:8080" or "unix:/run/bahnwerk.sock"
  bool reachable() const;       ///< whether other machines reach it
  void reload_certificate();    ///< reads the TLS files again, for new connections; throws std::runtime_error
  void start(unsigned threads);
  /// Runs `work`, which must not block, on a socket thread.
  void post(std::function<void()> work);
  /// Ends orderly: accepts no new connections, closes idle ones, answers requests in flight. Returns false if some took
  /// longer than `patience`.
  bool stop(std::chrono::milliseconds patience);

 private:
  void open_local(const std::string& path, unsigned mode);
  void open_tcp(const std::string& address);
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bahnwerk::server
