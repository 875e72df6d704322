#pragma once
/// Which hosts the service calls.
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::server {

/// Returns whether an IP address is one of the public Internet: not loopback, private, shared, link-local, multicast or
/// reserved [RFC 6890], also where it stands for an IPv4 address. False for what is no address.
bool is_public_address(const std::string& address);

/// The hosts that an operator allows: names and addresses; *.NAME, all names below a name; *, all. One that is listed
/// as it is may have any address, the others public ones alone.
class CallbackHosts {
 public:
  /// Throws std::invalid_argument with a sentence for the operator.
  explicit CallbackHosts(const std::vector<std::string>& list = {});
  bool empty() const { return exact_.empty() && suffixes_.empty(); }

  /// Returns why an http or https URL may not be called, in words for whoever posts it; empty: it may.
  std::string refusal(const std::string& url) const;
  /// Returns whether a connection to this address may be made for the URL, whose host is allowed.
  bool may_connect(const std::string& url, const std::string& address) const;

 private:
  bool exact(std::string_view host) const;
  std::vector<std::string> exact_, suffixes_;  ///< hosts in lower case; a suffix begins with a point, or is empty: all
};

/// Returns SCHEME://HOST:PORT of an http or https URL, in lower case: what one receiver is; empty: it is no such URL.
std::string receiver_of(const std::string& url);

}  // namespace bahnwerk::server
