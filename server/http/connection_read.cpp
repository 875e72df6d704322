/// How a connection reads a request: its header, its body, and what of both is refused.
#include <algorithm>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <new>

#include "server/http/connection.hpp"
#include "server/http/endpoints.hpp"
#include "server/http/handover.hpp"
#include "server/http/uri.hpp"

namespace bahnwerk::server {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using beast::error_code;

namespace {

constexpr std::chrono::milliseconds spare_patience{2'000};

int fault_status(const error_code& error) {
  if (error == http::error::header_limit || error == http::error::buffer_overflow) return 431;
  if (error == http::error::body_limit) return 413;
  if (error == http::error::bad_version) return 505;
  return error.category() == make_error_code(http::error::bad_line_ending).category() &&
                 error != http::error::end_of_stream && error != http::error::partial_message
             ? 400
             : 0;
}

/// Bytes of blank lines before a request: some clients send one after a body [RFC 9112, 2.2].
constexpr std::size_t most_blank = 16;

std::size_t skip_blank_lines(beast::flat_buffer& buffer) {
  std::size_t skipped = 0;
  for (;;) {
    const std::string_view text(static_cast<const char*>(buffer.data().data()), buffer.size());
    if (!text.starts_with("\r\n") || skipped > most_blank) return skipped;
    buffer.consume(2);
    skipped += 2;
  }
}

/// The error of a request whose body exceeds the memory left for all bodies.
const error_code no_room = make_error_code(boost::system::errc::not_enough_memory);

}  // namespace

/// A composed read would miss a cut that falls between two of its parts; this asks before every one.
asio::awaitable<error_code> Connection::read_some() {
  if (cut_ != Cut::none) co_return asio::error::operation_aborted;
  const std::size_t room = std::min(max_read, buffer_.max_size() - buffer_.size());
  if (room == 0) co_return http::error::buffer_overflow;
  auto [error, size] = co_await stream_.async_read_some(buffer_.prepare(room), tuple_awaitable);
  buffer_.commit(size);
  co_return error;
}

template <class Parser>
asio::awaitable<error_code> Connection::read_header(Parser& parser) {
  const Limits& limits = context_->limits;
  const auto whole = std::min(limits.header_timeout, spare_ ? spare_patience : limits.header_timeout);
  if (first_)
    read_until(connected_ + whole);
  else if (buffer_.size() == 0)
    read_until(std::chrono::steady_clock::now() + limits.idle_timeout);
  bool begun = false;
  for (std::size_t blank = 0;;) {
    if (!begun) blank += skip_blank_lines(buffer_);
    if (blank > most_blank) co_return http::error::bad_line_ending;
    if (buffer_.size() > (begun ? 0 : 1)) {
      error_code error;
      buffer_.consume(parser.put(buffer_.data(), error));
      if (error != http::error::need_more) co_return error;
      if (!begun && !first_) read_until(std::chrono::steady_clock::now() + whole);
      begun = true;
    }
    const error_code error = co_await read_some();
    if (error && begun && error == asio::error::eof) co_return http::error::partial_message;
    if (error) co_return begun || cut_ == Cut::none ? error : error_code(http::error::end_of_stream);
  }
}

template <class Parser>
asio::awaitable<error_code> Connection::read_body(Parser& parser, Request& request) {
  const auto share = std::make_shared<BodyBudget::Share>(context_->bodies);
  request.body_share = share;
  parser.eager(true);
  parser.body_limit(context_->limits.max_body);
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t received = 0, fresh = buffer_.size();; fresh = buffer_.size() - fresh) {
    if (!share->add(fresh)) co_return no_room;
    received += fresh;
    if (parser.chunked() && received > context_->limits.max_body)
      co_return http::error::body_limit;  // the framing counts, too
    try {
      while (buffer_.size() > 0 && !parser.is_done()) {
        error_code error;
        const std::size_t used = parser.put(buffer_.data(), error);
        buffer_.consume(used);
        if (error == http::error::need_more) break;
        if (error) co_return error;
        if (used == 0) break;
      }
    } catch (const std::bad_alloc&) {  // the body's string cannot grow
      co_return no_room;
    }
    if (parser.is_done()) co_return error_code();
    const std::chrono::milliseconds allowed(received / bytes_per_ms);
    read_until(start + context_->limits.body_timeout + allowed);
    enter(ConnectionTable::Phase::body, ConnectionTable::body_since(start, allowed, std::chrono::steady_clock::now()));
    fresh = buffer_.size();  // the begin of a chunk's header, maybe
    const error_code error = co_await read_some();
    if (error) co_return error == asio::error::eof ? error_code(http::error::partial_message) : error;
  }
}

asio::awaitable<std::optional<Connection::Incoming>> Connection::read() {
  const Limits& limits = context_->limits;
  const std::string too_large =
      "The request body, its framing included, is larger than " + std::to_string(limits.max_body) + " bytes.";
  Incoming incoming;
  const auto broken = [&](int status, const std::string& detail) {
    incoming.keep_alive = false;
    incoming.request->fault = Fault{status, detail};
    return std::optional(std::move(incoming));
  };
  const auto late = [&](const char* part) {
    return broken(408, cut_ == Cut::timeout ? "The request's " + std::string(part) + " did not arrive in time."
                       : cut_ == Cut::crowded
                           ? "The request's " + std::string(part) + " came slowly, and others wait for a connection."
                           : "The server is about to stop.");
  };
  Request& request = *incoming.request;
  request.peer = peer_;
  request.secure = stream_.secure();
  stream_.expires_never();
  cut_ = Cut::none;
  enter(ConnectionTable::Phase::waiting);
  if (context_->closing || leaving_) co_return std::nullopt;

  http::request_parser<http::string_body> parser;
  parser.header_limit(static_cast<std::uint32_t>(limits.max_header));
  parser.body_limit(boost::none);  // compared below, where there is an answer to it
  const error_code error = co_await read_header(parser);
  first_ = false;
  stop_clock();
  const struct Done {  // nobody cuts the connection from here on, except in the middle of the body
    Connection& connection;
    ~Done() {
      connection.stop_clock();
      connection.enter(ConnectionTable::Phase::busy);
    }
  } done{*this};
  if (error) {
    if (cut_ != Cut::none && error != http::error::end_of_stream) co_return late("header");
    const int status = fault_status(error);
    if (status == 0) co_return std::nullopt;
    co_return broken(status, "The request's header is malformed: " + error.message() + ".");
  }
  auto& message = parser.get();
  request.method = message.method_string();
  request.target = message.target();
  for (const auto& field : message) request.headers.emplace_back(lower(field.name_string()), field.value());
  if (proxied_) apply_forwarded(context_->hooks.proxies, request);
  incoming.http_1_0 = message.version() == 10;
  incoming.keep_alive = message.keep_alive() && !context_->closing && !spare_;

  if (parser.content_length() && *parser.content_length() > limits.max_body) co_return broken(413, too_large);
  if (const auto coding = request.header("transfer-encoding"); coding && lower(*coding) != "chunked")
    co_return broken(501, "Of the transfer codings only chunked is known.");
  // What an HTTP/1.0 client, or a proxy before it, takes for the end of this request is not known [RFC 9112, 6.1].
  if (incoming.http_1_0 && request.header("transfer-encoding"))
    co_return broken(400, "Before version 1.1 of HTTP a request has no Transfer-Encoding: where it ends is not sure.");
  const std::size_t hosts = message.count(http::field::host);
  if (hosts > 1 || (hosts == 0 && message.version() == 11))
    co_return broken(400, "An HTTP/1.1 request needs exactly one Host header.");
  if (hosts == 1 && !host_of(*request.header("host")))
    co_return broken(400, "The Host header is no HOST or HOST:PORT.");
  const auto target = parse_target(request.target);
  if (!target || (target->path == "*" && request.method != "OPTIONS"))
    co_return broken(400, "The request's target is malformed.");
  request.path = target->path;
  request.authority = target->authority.empty() ? request.header("host").value_or("") : target->authority;
  request.segments = target->segments;
  request.query = target->query;
  if (spare_ && request.path != "/healthz" && request.path != "/readyz")
    co_return broken(503, "All connections are in use; this one serves health and readiness only.");

  if (proxied_ && !context_->table.assign(id_, request.peer == peer_ ? "" : address_key(request.peer),
                                          std::chrono::steady_clock::now()))
    co_return broken(503, "The client of the proxy has all the connections that one address may have.");

  if (!parser.is_done()) {
    const auto expect = request.header("expect");
    if (expect && lower(*expect) != "100-continue") co_return broken(417, "Only 100-continue can be expected.");
    if (expect && !incoming.http_1_0) {  // 100 is not known there [RFC 9110, 10.1.1]
      const bool written = co_await write_raw("HTTP/1.1 100 Continue\r\n\r\n");
      if (!written) co_return std::nullopt;
      stream_.expires_never();
    }
    const error_code failed = co_await read_body(parser, request);
    if (failed) {
      if (cut_ != Cut::none) co_return late("body");
      if (failed == no_room)
        co_return broken(503, "The bodies of other requests take all the memory set aside for them.");
      const int status = fault_status(failed);
      if (status == 0) co_return std::nullopt;
      co_return broken(status,
                       status == 413 ? too_large : "The request's body is malformed: " + failed.message() + ".");
    }
    request.body = std::move(parser.get().body());
  }
  co_return std::optional(std::move(incoming));
}

}  // namespace bahnwerk::server
