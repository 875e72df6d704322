#include "server/http/connection.hpp"

#include <netinet/tcp.h>

#include <algorithm>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include "server/http/handover.hpp"
#include "server/http/uri.hpp"
#include "server/runtime/log.hpp"

namespace bahnwerk::server {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using beast::error_code;

struct Connection::Incoming {
  RequestPtr request = std::make_shared<Request>();
  bool keep_alive = false;
  bool http_1_0 = false;
};

namespace {

constexpr std::size_t read_size = 64 << 10;
constexpr std::size_t bytes_per_ms = 100;  // 100 kB/s: what a slow client has to manage
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

/// The error of a request for whose body the memory for all bodies has no room.
const error_code no_room = make_error_code(boost::system::errc::not_enough_memory);

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::string http_date() {
  char text[40];
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  const std::size_t size = std::strftime(text, sizeof text, "%a, %d %b %Y %H:%M:%S GMT", &parts);
  return {text, size};
}

/// A client whose machine or cable has failed closes nothing: what it does not confirm within this time ends its
/// connection, a question of ours included that is put to it in silence.
void notice_vanished_client(asio::ip::tcp::socket& socket) {
  using Milliseconds = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_USER_TIMEOUT>;
  using Idle = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPIDLE>;
  using Interval = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPINTVL>;
  constexpr int seconds = 30;
  error_code ignored;
  socket.set_option(Milliseconds(seconds * 1000), ignored);
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  socket.set_option(Idle(seconds), ignored);
  socket.set_option(Interval(seconds / 3), ignored);
}

template <class Message>
void put_headers(Message& message, const Response& response) {
  message.set(http::field::date, http_date());
  message.set("X-Content-Type-Options", "nosniff");
  for (const auto& [name, value] : response.headers) message.insert(name, value);
}

}  // namespace

Connection::Connection(asio::ip::tcp::socket socket, std::shared_ptr<ConnectionContext> context, ConnectionTable::Id id,
                       bool spare)
    : stream_(std::move(socket)),
      context_(std::move(context)),
      buffer_(context_->limits.max_header + read_size),
      timer_(stream_.get_executor()),
      id_(id),
      spare_(spare) {
  error_code ignored;
  stream_.socket().set_option(asio::ip::tcp::no_delay(true), ignored);
  notice_vanished_client(stream_.socket());
  const auto remote = stream_.socket().remote_endpoint(ignored);
  if (!ignored) peer_ = remote.address().to_string();
}

void Connection::expire(std::chrono::milliseconds base, std::size_t bytes) {
  stream_.expires_after(base + std::chrono::milliseconds(bytes / bytes_per_ms));
}

// The stream's own timer closes the socket when it expires; a separate timer ends reading, so that the client can still
// get an answer.
void Connection::read_until(Time until) {
  const auto turn = ++turn_;
  timer_.expires_at(until);
  timer_.async_wait([weak = weak_from_this(), turn](const error_code& error) {
    const auto self = weak.lock();
    if (!error && self && self->turn_ == turn) self->stop_reading(Cut::timeout);
  });
}

void Connection::stop_clock() {
  ++turn_;
  timer_.cancel();
}

void Connection::stop_reading(Cut why) {
  cut_ = why;
  stream_.cancel();
}

void Connection::cut(Cut why) {
  asio::post(stream_.get_executor(), [self = shared_from_this(), why] {
    self->leaving_ = true;
    if (self->reading_ && !(self->lingering_ && why == Cut::closing)) self->stop_reading(why);
  });
}

void Connection::enter(ConnectionTable::Phase phase) {
  reading_ = phase == ConnectionTable::Phase::waiting || phase == ConnectionTable::Phase::body;
  if (const auto crowded = context_->table.enter(id_, phase, std::chrono::steady_clock::now()))
    context_->finish(*crowded);
}

/// A composed read would miss a cut that falls between two of its parts; this asks before every one.
asio::awaitable<error_code> Connection::read_some() {
  if (cut_ != Cut::none) co_return asio::error::operation_aborted;
  const std::size_t room = std::min(read_size, buffer_.max_size() - buffer_.size());
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
    read_until(start + context_->limits.body_timeout + std::chrono::milliseconds(received / bytes_per_ms));
    enter(ConnectionTable::Phase::body);
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

asio::awaitable<Response> Connection::answer(RequestPtr request) {
  request->listen = [weak = weak_from_this(), answer = answer_](std::function<void()> finish) {
    const auto self = weak.lock();
    if (!self) return finish();
    asio::post(self->stream_.get_executor(), [self, answer, finish = std::move(finish)]() mutable {
      if (self->answer_ == answer) self->listen(std::move(finish));
    });
  };
  const auto handover = std::make_shared<Handover<Response>>(stream_.get_executor());
  {
    const auto promise = std::make_shared<Promise>(handover);
    context_->hooks.handler(std::move(request), [promise](Response response) {
      Handover<Response>::set(promise->handover, std::move(response));
    });
  }
  Response response = co_await handover->get();
  stop_listening();
  co_return response;
}

asio::awaitable<bool> Connection::write_raw(std::string text) {
  expire(context_->limits.write_timeout, text.size());
  auto [error, size] = co_await asio::async_write(stream_, asio::buffer(text), tuple_awaitable);
  co_return !error;
}

asio::awaitable<bool> Connection::write(Response response, const Incoming& incoming) {
  if (response.stream || response.feed) co_return co_await write_stream(std::move(response), incoming);
  const bool bodiless = response.status == 204 || response.status == 304;
  http::response<http::string_body> message(static_cast<http::status>(response.status), incoming.http_1_0 ? 10 : 11);
  put_headers(message, response);
  message.keep_alive(incoming.keep_alive);
  if (!bodiless) message.content_length(response.body.size());
  expire(context_->limits.write_timeout, response.body.size());
  if (!bodiless && incoming.request->method != "HEAD") message.body() = std::move(response.body);
  http::response_serializer<http::string_body> serializer(message);
  if (message.body().empty()) {
    auto [error, size] = co_await http::async_write_header(stream_, serializer, tuple_awaitable);
    co_return !error;
  }
  auto [error, size] = co_await http::async_write(stream_, serializer, tuple_awaitable);
  co_return !error;
}

asio::awaitable<bool> Connection::write_stream(Response response, const Incoming& incoming) {
  struct Piece {
    std::string text;
    bool more = false, failed = false;
  };
  const auto length = response.length;
  // HTTP/1.0 has no chunks: without a length the end of the answer is the connection's end.
  const bool chunked = !incoming.http_1_0 && !length;
  http::response<http::empty_body> message(static_cast<http::status>(response.status), incoming.http_1_0 ? 10 : 11);
  put_headers(message, response);
  const auto feed = std::move(response.feed);
  message.keep_alive(incoming.keep_alive && (chunked || length) && !feed);
  if (chunked) message.chunked(true);
  if (length) message.content_length(*length);
  http::response_serializer<http::empty_body> serializer(message);
  stream_.expires_after(context_->limits.write_timeout);
  auto [error, size] = co_await http::async_write_header(stream_, serializer, tuple_awaitable);
  if (error) co_return false;
  if (incoming.request->method == "HEAD") co_return chunked || length;
  if (feed) listen([feed] { feed->stop(); });

  const auto pull = std::make_shared<std::function<bool(std::string&)>>(std::move(response.stream));
  std::size_t sent = 0;
  for (bool more = true; more;) {
    const auto handover = std::make_shared<Handover<Piece>>(stream_.get_executor());
    if (feed) {
      feed->next([handover](std::optional<std::string> text) {
        const bool piece_follows = text.has_value();
        Handover<Piece>::set(handover, {std::move(text).value_or(""), piece_follows, false});
      });
    } else {
      context_->hooks.offload([pull, handover, id = incoming.request->id] {
        Piece piece;
        try {
          piece.more = (*pull)(piece.text);
        } catch (const std::exception& failure) {
          piece.failed = true;
          log::error("stream_failed", {{"request", id}, {"detail", failure.what()}});
        }
        Handover<Piece>::set(handover, std::move(piece));
      });
    }
    const Piece piece = co_await handover->get();
    if (piece.failed) co_return false;
    more = piece.more;
    if (piece.text.empty()) continue;  // an empty chunk would mean the end
    sent += piece.text.size();
    if (length && sent > *length) co_return false;
    expire(context_->limits.write_timeout, piece.text.size());
    if (chunked) {
      auto [failed, written] =
          co_await asio::async_write(stream_, http::make_chunk(asio::buffer(piece.text)), tuple_awaitable);
      if (failed) co_return false;
    } else {
      auto [failed, written] = co_await asio::async_write(stream_, asio::buffer(piece.text), tuple_awaitable);
      if (failed) co_return false;
    }
  }
  if (!chunked) co_return length&& sent == *length;
  const bool ended = co_await write_raw("0\r\n\r\n");
  co_return ended && !feed;  // a feed's connection may have lasted for hours: it ends here
}

void Connection::listen(std::function<void()> finish) {
  finish_ = std::move(finish);
  enter(ConnectionTable::Phase::listening);
  finish_when_gone(answer_, false);
}

bool Connection::client_left() {
  tcp_info info{};
  socklen_t size = sizeof info;
  const int socket = stream_.socket().native_handle();
  return ::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) != 0 || info.tcpi_state != TCP_ESTABLISHED;
}

// Bytes of a further request hide the end of the connection behind them: then its state is asked for, once a second.
void Connection::finish_when_gone(std::uint64_t answer, bool asked_again) {
  const auto look = [weak = weak_from_this(), answer](const error_code& error) {
    const auto self = weak.lock();
    if (!self || error == asio::error::operation_aborted || self->answer_ != answer || !self->finish_) return;
    if (self->client_left()) return std::exchange(self->finish_, nullptr)();
    self->finish_when_gone(answer, true);
  };
  if (!asked_again) return stream_.socket().async_wait(asio::ip::tcp::socket::wait_read, look);
  timer_.expires_after(std::chrono::seconds(1));
  timer_.async_wait(look);
}

void Connection::stop_listening() {
  ++answer_;
  if (!finish_) return;
  finish_ = nullptr;
  enter(ConnectionTable::Phase::busy);
}

void Connection::finish_listening() {
  asio::post(stream_.get_executor(), [self = shared_from_this()] {
    if (self->finish_) std::exchange(self->finish_, nullptr)();
  });
}

asio::awaitable<void> Connection::linger() {
  // Closing with unread input would reset the connection, and the client might lose the answer.
  error_code ignored;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  stream_.expires_after(std::chrono::seconds(2));
  buffer_.clear();
  cut_ = Cut::none;
  lingering_ = true;
  enter(ConnectionTable::Phase::waiting);
  while (cut_ == Cut::none) {
    auto [error, size] = co_await stream_.async_read_some(buffer_.prepare(32 << 10), tuple_awaitable);
    if (error) co_return;
  }
}

asio::awaitable<void> Connection::serve() {
  for (;;) {
    std::optional<Incoming> incoming = co_await read();
    if (!incoming) break;
    Response response = co_await answer(incoming->request);
    if (response.close || context_->closing || leaving_) incoming->keep_alive = false;
    const bool written = co_await write(std::move(response), *incoming);
    stop_listening();
    if (!written) break;
    if (!incoming->keep_alive) {
      co_await linger();
      break;
    }
  }
  stream_.close();
}

}  // namespace bahnwerk::server
