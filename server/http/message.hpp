#pragma once
/// A request and its answer as plain values for handlers, without sockets or Beast.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bahnwerk::server {
struct HeldKey;  // server/keys/key_ring.hpp

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// A broken or too large message: the answer to give instead of handling it.
struct Fault {
  int status;
  std::string detail;
};

struct Request {
  std::string method;                 ///< upper case as sent
  std::string target;                 ///< target as sent
  std::string authority;              ///< HOST[:PORT] that was asked; empty: not given (HTTP/1.0)
  std::string path;                   ///< decoded path, for messages and logs; "*": the whole server (OPTIONS)
  std::vector<std::string> segments;  ///< the path's parts, each decoded: "/v1/jobs/a%2Fb" → v1, jobs, a/b
  Pairs query;                        ///< decoded parameters, in order
  Pairs headers;                      ///< names in lower case, in order
  std::string body;
  std::shared_ptr<void> body_share;  ///< part of the memory for bodies; returned with the last copy
  std::string peer;                  ///< client's address, by a trusted proxy's word where there is one; "unix": none
  bool secure = false;               ///< whether the client speaks TLS, with this service or a trusted proxy
  std::string prefix;                ///< what a trusted proxy puts before our paths, e.g. "/plan"; else empty
  /// Has to be called, from any thread, by a handler whose answer waits for something to happen. The connection then
  /// counts as a listener, and calls `finish`, once and from any thread, when the client has left or others need the
  /// connection: the answer is to be given at once, as it is. Set by the connection; empty in requests without one.
  std::function<void(std::function<void()> finish)> listen;

  std::string id;                      ///< request id, set by middleware
  std::shared_ptr<const HeldKey> key;  ///< who asks, set by the gate; nullptr: nobody needs a key, or none was needed
  std::string route;                   ///< the matched pattern, set by the router; empty when none matched
  Pairs parameters;                    ///< values of the pattern's names, e.g. {id}
  std::optional<Fault> fault;          ///< if set, the other members are incomplete

  /// Returns the value of a header (lower-case name), several lines joined by ", "; nullopt when absent.
  std::optional<std::string> header(std::string_view name) const;
  const std::string& parameter(
      std::string_view name) const;  ///< value of a name in the matched pattern; throws std::out_of_range
};

/// A body that is produced while it is sent, possibly for hours, without a waiting thread.
class Feed {
 public:
  using Ready = std::function<void(std::optional<std::string>)>;
  virtual ~Feed() = default;
  /// Calls `ready` once, from any thread, with the next piece, or with nullopt at the end. Must not block.
  virtual void next(Ready ready) = 0;
  virtual void stop() = 0;  ///< the client has disconnected; from any thread
};

struct Response {
  int status = 200;
  Pairs headers;
  std::string body;
  /// An alternative to `body`: it is called until it returns false and appends a piece each time. Written chunked. May
  /// block. If it throws, the connection is aborted, so that the client sees that the answer is incomplete.
  std::function<bool(std::string&)> stream;
  std::optional<std::size_t> length;  ///< bytes of all pieces of `stream`, if known: written as Content-Length instead
  std::shared_ptr<Feed> feed;         ///< instead of both; the connection ends with it
  std::string_view problem;           ///< slug of the problem that it reports; empty: none
  bool close = false;                 ///< end the connection after this answer

  Response& set(std::string name, std::string value);  ///< replaces a header of that name (exact spelling)
  std::optional<std::string> header(std::string_view name) const;
};

/// Takes the answer, once, from any thread.
using Reply = std::function<void(Response)>;
using RequestPtr = std::shared_ptr<Request>;
using Handler = std::function<void(RequestPtr, Reply)>;
/// Wraps a handler into another one. The first of a list is the outermost.
using Middleware = std::function<Handler(Handler)>;
Handler compose(const std::vector<Middleware>& list, Handler innermost);

}  // namespace bahnwerk::server
