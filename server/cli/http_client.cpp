#include "server/cli/http_client.hpp"

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/url/parse.hpp>
#include <boost/url/url_view.hpp>

#include "api/text/base64.hpp"

namespace bahnwerk::server::cli {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;

namespace {

constexpr std::chrono::seconds connect_patience{10};
constexpr std::chrono::seconds silence_patience{90};  ///< patience beyond the longest wait that a server grants

/// Runs one asynchronous operation to its end under the stream's timeout, because synchronous calls have none.
template <class Start>
beast::error_code finish(asio::io_context& io, beast::tcp_stream& stream, std::chrono::seconds patience,
                         Start&& start) {
  beast::error_code result;
  stream.expires_after(patience);
  start([&result](beast::error_code error, auto&&...) { result = error; });
  io.restart();
  io.run();
  return result;
}

}  // namespace

HttpClient::HttpClient(std::string url) : url_(url) {
  const auto parsed = boost::urls::parse_uri(url);
  if (parsed && parsed->scheme() == "https")
    throw std::invalid_argument("https is not available; use http://HOST:PORT");
  if (!parsed || parsed->scheme() != "http" || parsed->host().empty())
    throw std::invalid_argument("'" + url_ + "' is no server; expected http://HOST:PORT");
  host_ = parsed->host_address();
  port_ = parsed->has_port() ? std::string(parsed->port()) : "80";
  prefix_ = parsed->encoded_path();
  while (prefix_.ends_with('/')) prefix_.pop_back();
  if (!parsed->has_userinfo()) return;
  authorization_ = "Basic " + api::base64(parsed->user() + ":" + parsed->password());
  url_ = "http://" + std::string(parsed->encoded_host_and_port()) + prefix_;  // for messages, without the password
}

Response HttpClient::request(const std::string& method, const std::string& target, const Pairs& headers,
                             const std::string& body, const std::function<void(std::string_view)>& sink) const {
  asio::io_context io;
  beast::tcp_stream stream(io);
  bool connected = false;
  const auto check = [&](const beast::error_code& error, const char* what) {
    if (error) throw Unreachable("no answer from " + url_ + ": " + what + ": " + error.message(), connected);
  };
  beast::error_code error;
  const auto found = asio::ip::tcp::resolver(io).resolve(host_, port_, error);
  check(error, "name lookup");
  check(finish(io, stream, connect_patience, [&](auto done) { stream.async_connect(found, done); }), "connect");
  connected = true;

  http::request<http::string_body> message(http::string_to_verb(method), prefix_ + target, 11);
  message.set(http::field::host, host_ + ":" + port_);
  message.set(http::field::user_agent, "bahnwerk");
  message.set(http::field::connection, "close");
  if (!authorization_.empty()) message.set(http::field::authorization, authorization_);
  for (const auto& [name, value] : headers) message.set(name, value);
  message.body() = body;
  if (method == "POST" || !body.empty()) message.content_length(body.size());
  const auto sent = finish(io, stream, silence_patience, [&](auto done) { http::async_write(stream, message, done); });
  // A server that refuses a large body may close its side early; its answer is still worth reading.
  if (sent && sent != asio::error::broken_pipe && sent != asio::error::connection_reset) check(sent, "send");

  beast::flat_buffer buffer;
  http::response_parser<http::buffer_body> parser;
  parser.body_limit(boost::none);
  check(finish(io, stream, silence_patience, [&](auto done) { http::async_read_header(stream, buffer, parser, done); }),
        "read");
  Response response;
  response.status = static_cast<int>(parser.get().result_int());
  for (const auto& field : parser.get()) response.headers.emplace_back(field.name_string(), field.value());
  std::array<char, 64 << 10> piece;
  while (!parser.is_done()) {
    parser.get().body().data = piece.data();
    parser.get().body().size = piece.size();
    auto read =
        finish(io, stream, silence_patience, [&](auto done) { http::async_read_some(stream, buffer, parser, done); });
    if (read == http::error::need_buffer) read = {};
    check(read, "the answer broke off");
    const std::string_view text(piece.data(), piece.size() - parser.get().body().size);
    if (text.empty()) continue;
    if (sink && response.status / 100 == 2)
      sink(text);
    else
      response.body.append(text);
  }
  return response;
}

}  // namespace bahnwerk::server::cli
