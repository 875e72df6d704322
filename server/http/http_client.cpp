#include "server/http/http_client.hpp"

#include <algorithm>
#include <array>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/url/parse.hpp>
#include <boost/url/url_view.hpp>
#include <vector>

#include "api/text/base64.hpp"

namespace bahnwerk::server {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;

namespace {

constexpr std::chrono::seconds connect_patience{10};
constexpr std::chrono::seconds silence_patience{90};  ///< patience beyond the longest wait that a server grants

using Plain = beast::basic_stream<asio::generic::stream_protocol>;

struct Check {
  const std::string& url;
  bool connected;
  void operator()(const beast::error_code& error, const std::string& what) const {
    if (error) throw Unreachable("no answer from " + url + ": " + what + ": " + error.message(), connected);
  }
};

asio::ssl::context tls_context(const Credentials& credentials) {
  asio::ssl::context context(asio::ssl::context::tls_client);
  SSL_CTX_set_min_proto_version(context.native_handle(), TLS1_2_VERSION);
  beast::error_code error;
  const auto check = [&](const std::string& file) {
    if (error) throw std::invalid_argument("cannot take " + file + ": " + error.message());
  };
  if (credentials.ca.empty())
    context.set_default_verify_paths(error);
  else
    context.load_verify_file(credentials.ca, error);
  check(credentials.ca);
  if (!credentials.certificate.empty()) {
    context.use_certificate_chain_file(credentials.certificate, error);
    check(credentials.certificate);
    const std::string& key = credentials.certificate_key;
    context.use_private_key_file(key.empty() ? credentials.certificate : key, asio::ssl::context::pem, error);
    check(key);
  }
  context.set_verify_mode(asio::ssl::verify_peer);
  return context;
}

}  // namespace

/// Runs asynchronous operations to their ends, because synchronous calls have no timeout.
class HttpClient::Clock {
 public:
  explicit Clock(const RequestLimits& limits) : limits_(limits) {}

  template <class Stream, class Start>
  beast::error_code finish(Stream& stream, std::chrono::seconds patience, Start&& start) const {
    constexpr std::chrono::milliseconds between_questions{100};
    beast::error_code result;
    const auto until = std::chrono::steady_clock::now() + patience;
    stream.expires_at(limits_.time.count() > 0 ? std::min(until, begin_ + limits_.time) : until);
    start([&result](beast::error_code error, auto&&...) { result = error; });
    auto& io = static_cast<asio::io_context&>(stream.get_executor().context());
    io.restart();
    if (limits_.stop)
      for (bool stopped = false; !io.stopped();) {
        io.run_for(between_questions);
        if (!stopped && !io.stopped() && limits_.stop()) stream.cancel(), stopped = true;
      }
    io.run();
    return result;
  }

 private:
  const RequestLimits& limits_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

HttpClient::HttpClient(std::string url, Credentials credentials, RequestLimits limits)
    : credentials_(std::move(credentials)), limits_(std::move(limits)), url_(std::move(url)) {
  if (!credentials_.key.empty()) authorization_ = "Bearer " + credentials_.key;
  if (url_.starts_with("unix:") && url_.size() > 5) {
    socket_path_ = url_.substr(5);
    host_ = "localhost";
    return;
  }
  const auto parsed = boost::urls::parse_uri(url_);
  tls_ = parsed && parsed->scheme() == "https";
  if (!parsed || (parsed->scheme() != "http" && !tls_) || parsed->host().empty())
    throw std::invalid_argument("'" + url_ +
                                "' is no server; expected http://HOST:PORT, https://HOST:PORT or unix:PATH");
  host_ = parsed->host_address();
  port_ = parsed->has_port() ? std::string(parsed->port()) : tls_ ? "443" : "80";
  prefix_ = parsed->encoded_path();
  while (prefix_.ends_with('/')) prefix_.pop_back();
  if (!parsed->has_userinfo()) return;
  authorization_ = "Basic " + api::base64(parsed->user() + ":" + parsed->password());
  // For messages, without the password.
  url_ = std::string(parsed->scheme()) + "://" + std::string(parsed->encoded_host_and_port()) + prefix_;
}

Response HttpClient::request(const std::string& method, const std::string& target, const Pairs& headers,
                             const std::string& body, const std::function<void(std::string_view)>& sink) const {
  asio::io_context io;
  beast::error_code error;
  const Check check{url_, false};
  const Clock clock(limits_);
  std::optional<Plain> plain;
  if (!socket_path_.empty()) {
    asio::local::stream_protocol::socket socket(io);
    socket.connect(socket_path_, error);
    check(error, "connect");
    plain.emplace(std::move(socket));
  } else {
    beast::tcp_stream stream(io);
    const auto found = asio::ip::tcp::resolver(io).resolve(host_, port_, error);
    check(error, "name lookup");
    std::vector<asio::ip::tcp::endpoint> places;
    for (const auto& each : found)
      if (!limits_.may_connect || limits_.may_connect(each.endpoint().address().to_string()))
        places.push_back(each.endpoint());
    if (places.empty()) error = asio::error::access_denied;
    check(error, "its address may not be connected to");
    check(clock.finish(stream, connect_patience, [&](auto done) { stream.async_connect(places, done); }), "connect");
    plain.emplace(stream.release_socket());
  }

  http::request<http::string_body> message(http::string_to_verb(method), prefix_ + target, 11);
  message.set(http::field::host, port_.empty() ? host_ : host_ + ":" + port_);
  message.set(http::field::user_agent, "bahnwerk");
  message.set(http::field::connection, "close");
  if (!authorization_.empty()) message.set(http::field::authorization, authorization_);
  for (const auto& [name, value] : headers) message.set(name, value);
  message.body() = body;
  if (method == "POST" || !body.empty()) message.content_length(body.size());

  if (!tls_) return exchange(clock, *plain, message, sink);
  auto context = tls_context(credentials_);
  asio::ssl::stream<Plain&> secure(*plain, context);
  asio::ip::make_address(host_, error);
  if (error) SSL_set_tlsext_host_name(secure.native_handle(), host_.c_str());  // an address has no place there
  secure.set_verify_callback(asio::ssl::host_name_verification(host_));
  const auto shaken = clock.finish(*plain, connect_patience,
                                   [&](auto done) { secure.async_handshake(asio::ssl::stream_base::client, done); });
  check(shaken, "TLS");
  return exchange(clock, secure, message, sink);
}

/// Sends a message and reads the answer, on a stream that is connected.
template <class Stream, class Message>
Response HttpClient::exchange(const Clock& clock, Stream& stream, const Message& message,
                              const std::function<void(std::string_view)>& sink) const {
  const Check check{url_, true};
  auto& plain = beast::get_lowest_layer(stream);
  const auto sent = clock.finish(plain, silence_patience, [&](auto done) { http::async_write(stream, message, done); });
  // A server that refuses a large body may close its side early; its answer is still worth reading.
  if (sent && sent != asio::error::broken_pipe && sent != asio::error::connection_reset) check(sent, "send");

  beast::flat_buffer buffer;
  http::response_parser<http::buffer_body> parser;
  parser.body_limit(boost::none);
  check(
      clock.finish(plain, silence_patience, [&](auto done) { http::async_read_header(stream, buffer, parser, done); }),
      "read");
  Response response;
  response.status = static_cast<int>(parser.get().result_int());
  for (const auto& field : parser.get()) response.headers.emplace_back(field.name_string(), field.value());
  std::array<char, 64 << 10> piece;
  while (!parser.is_done() && (limits_.answer == 0 || response.body.size() < limits_.answer)) {
    parser.get().body().data = piece.data();
    parser.get().body().size = piece.size();
    auto read =
        clock.finish(plain, silence_patience, [&](auto done) { http::async_read_some(stream, buffer, parser, done); });
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

}  // namespace bahnwerk::server
