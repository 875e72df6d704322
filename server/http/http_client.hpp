#pragma once
/// A small blocking HTTP/1.1 client, for the terminal commands and for callbacks. It follows no redirects.
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>

#include "server/http/message.hpp"

namespace bahnwerk::server {

/// Thrown where no server answered or the connection broke; the text is a sentence for the user. `connected`: the
/// server was there, and may have acted on the request.
struct Unreachable : std::runtime_error {
  Unreachable(const std::string& what, bool was_connected) : std::runtime_error(what), connected(was_connected) {}
  bool connected;
};

/// What a server wants to see; files are PEM.
struct Credentials {
  std::string key;                           ///< sent as Authorization: Bearer, unless the address has a password
  std::string ca;                            ///< authorities for the server's certificate; empty: the system's
  std::string certificate, certificate_key;  ///< the client's own
};

/// What bounds a request to a server that nobody trusts.
struct RequestLimits {
  std::chrono::milliseconds time{0};  ///< longest time of a request, the name lookup left out; 0: no limit
  std::size_t answer = 0;             ///< bytes of the answer that are read; 0: no limit
  std::function<bool(const std::string& address)> may_connect = {};  ///< whether an IP address may be connected to
  std::function<bool()> stop = {};  ///< asked every 100 ms; true ends the request as Unreachable
};

class HttpClient {
 public:
  /// `url`: http[s]://[USER:PASSWORD@]HOST[:PORT][/PREFIX] or unix:PATH; throws std::invalid_argument.
  explicit HttpClient(std::string url, Credentials credentials = {}, RequestLimits limits = {});

  /// Sends one request on its own connection. The body of a 2xx answer is passed piece by piece to `sink`, if there is
  /// one.
  Response request(const std::string& method, const std::string& target, const Pairs& headers,
                   const std::string& body = {}, const std::function<void(std::string_view)>& sink = nullptr) const;

 private:
  class Clock;
  template <class Stream, class Message>
  Response exchange(const Clock& clock, Stream& stream, const Message& message,
                    const std::function<void(std::string_view)>& sink) const;
  const Credentials credentials_;
  const RequestLimits limits_;
  bool tls_ = false;
  std::string socket_path_;  ///< path of a Unix socket; empty: host and port
  std::string url_, host_, port_, prefix_, authorization_;
};

}  // namespace bahnwerk::server
