#pragma once
/// A small blocking HTTP/1.1 client for the terminal commands.
#include <functional>
#include <stdexcept>
#include <string>

#include "server/http/message.hpp"

namespace bahnwerk::server::cli {

/// Thrown where no server answered or the connection broke; the text is a sentence for the user. `connected`: the
/// server was there, and may have acted on the request.
struct Unreachable : std::runtime_error {
  Unreachable(const std::string& what, bool was_connected) : std::runtime_error(what), connected(was_connected) {}
  bool connected;
};

class HttpClient {
 public:
  explicit HttpClient(std::string url);  ///< http://[USER:PASSWORD@]HOST[:PORT][/PREFIX]; throws std::invalid_argument

  /// Sends one request on its own connection. The body of a 2xx answer is passed piece by piece to `sink`, if there is
  /// one.
  Response request(const std::string& method, const std::string& target, const Pairs& headers,
                   const std::string& body = {}, const std::function<void(std::string_view)>& sink = nullptr) const;

 private:
  std::string url_, host_, port_, prefix_, authorization_;
};

}  // namespace bahnwerk::server::cli
