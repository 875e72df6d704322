#pragma once
/// What a proxy before the service says about its clients.
#include <string>
#include <vector>

#include "server/http/message.hpp"

namespace bahnwerk::server {

/// Addresses and networks (10.0.0.0/8) of proxies whose word counts; "unix" are those that come by a Unix socket.
class TrustedProxies {
 public:
  TrustedProxies() = default;
  /// Throws std::runtime_error with a sentence for the operator if one is no address.
  explicit TrustedProxies(const std::vector<std::string>& list);
  bool contain(const std::string& address) const;

 private:
  struct Network {
    std::vector<unsigned char> bytes;
    unsigned bits = 0;
  };
  std::vector<Network> networks_;
  bool unix_ = false;
};

/// Takes peer, TLS and prefix of a request from its X-Forwarded-For, -Proto and -Prefix if its peer is trusted, and
/// removes these headers then. The client is the last address of the list that is no trusted proxy itself.
void apply_forwarded(const TrustedProxies& proxies, Request& request);

/// Tells whether a program on this machine asks, and not a proxy for somebody else.
bool from_this_machine(const Request& request);

}  // namespace bahnwerk::server
