#pragma once
/// Refuses requests that a page of another site makes in the browser of somebody who can reach this service.
#include <string>
#include <vector>

#include "server/http/message.hpp"

namespace bahnwerk::server {

/// The names by which this service may be asked. A page whose name was bound to this address after it was loaded asks
/// by its own name, and would read and post here otherwise.
struct AllowedHosts {
  bool any = false;                ///< every name is right
  std::vector<std::string> names;  ///< in lower case, without ports; names of the loopback interface are right as well
  /// Origins of other sites whose pages may ask and change, as --cors-origin gives them.
  std::vector<std::string> origins = {};
  bool contain(const std::string& host) const;
};

/// Tells whether an Origin header [RFC 6454] names the host and port that were asked, HOST[:PORT].
bool same_origin(const std::string& origin, const std::string& authority);

/// Returns the names for a service that listens at `bound` (HOST:PORT, an address), as it was told to at `listen`:
/// `given`, if there are any; else every name beyond loopback, and on loopback those of loopback and of `listen`.
AllowedHosts allowed_hosts(const std::string& listen, const std::string& bound, const std::vector<std::string>& given);

/// Throws std::runtime_error with a sentence for the operator if one is no origin, SCHEME://HOST[:PORT].
void check_origins(const std::vector<std::string>& origins);

/// Lets pages of the allowed origins read answers and, by answering what their browsers ask before, change something
/// [Fetch, CORS protocol]. Cookies of such requests are not asked for: pages send a key.
Middleware cors(const AllowedHosts& hosts);

/// Answers 403 to a request by another name, and to one that changes something if it comes from a page of another
/// origin [RFC 6454]. `hosts` outlives it.
Middleware same_site(const AllowedHosts& hosts);

}  // namespace bahnwerk::server
