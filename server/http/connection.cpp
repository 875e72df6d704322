#include "server/http/connection.hpp"

#include <netinet/tcp.h>
#include <poll.h>

#include <algorithm>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include "server/http/endpoints.hpp"
#include "server/http/handover.hpp"
#include "server/runtime/log.hpp"

namespace bahnwerk::server {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using beast::error_code;

namespace {

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
void notice_vanished_client(ClientStream::Socket& socket) {
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

Connection::Connection(ClientStream::Socket socket, std::shared_ptr<asio::ssl::context> tls,
                       std::shared_ptr<ConnectionContext> context, ConnectionTable::Id id, bool spare)
    : stream_(std::move(socket), std::move(tls)),
      context_(std::move(context)),
      buffer_(context_->limits.max_header + max_read),
      timer_(stream_.get_executor()),
      id_(id),
      spare_(spare) {
  error_code ignored;
  stream_.socket().set_option(asio::ip::tcp::no_delay(true), ignored);
  notice_vanished_client(stream_.socket());
  peer_ = peer_address(stream_.socket());
  proxied_ = context_->hooks.proxies.contain(peer_);
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

void Connection::enter(ConnectionTable::Phase phase, Time since) {
  reading_ = phase == ConnectionTable::Phase::waiting || phase == ConnectionTable::Phase::body;
  if (const auto crowded = context_->table.enter(id_, phase, since)) context_->finish(*crowded);
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
  pollfd client{.fd = stream_.socket().native_handle(), .events = POLLRDHUP, .revents = 0};
  return ::poll(&client, 1, 0) != 0;
}

// Bytes of a further request hide the end of the connection behind them: then its state is asked for, once a second.
void Connection::finish_when_gone(std::uint64_t answer, bool asked_again) {
  const auto look = [weak = weak_from_this(), answer](const error_code& error) {
    const auto self = weak.lock();
    if (!self || error == asio::error::operation_aborted || self->answer_ != answer || !self->finish_) return;
    if (self->client_left()) return std::exchange(self->finish_, nullptr)();
    self->finish_when_gone(answer, true);
  };
  if (!asked_again) return stream_.socket().async_wait(asio::socket_base::wait_read, look);
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
  stream_.expires_after(std::chrono::seconds(2));
  if (stream_.secure()) {  // tells the client that nothing is missing, and waits for its end of the connection
    lingering_ = true;
    enter(ConnectionTable::Phase::waiting);
    co_await stream_.async_shutdown(tuple_awaitable);
    co_return;
  }
  stream_.socket().shutdown(asio::socket_base::shutdown_send, ignored);
  buffer_.clear();
  cut_ = Cut::none;
  lingering_ = true;
  enter(ConnectionTable::Phase::waiting);
  while (cut_ == Cut::none) {
    auto [error, size] = co_await stream_.async_read_some(buffer_.prepare(32 << 10), tuple_awaitable);
    if (error) co_return;
  }
}

asio::awaitable<bool> Connection::greet() {
  if (!stream_.secure()) co_return true;
  enter(ConnectionTable::Phase::waiting);
  stream_.expires_after(context_->limits.header_timeout);
  auto [error] = co_await stream_.async_handshake(tuple_awaitable);
  co_return !error && cut_ == Cut::none;
}

asio::awaitable<void> Connection::serve() {
  const bool greeted = co_await greet();
  if (!greeted) co_return stream_.close();
  for (;;) {
    std::optional<Incoming> incoming = co_await read();
    if (!incoming) break;
    Response response = co_await answer(incoming->request);
    if (response.close || context_->closing || leaving_) incoming->keep_alive = false;
    const bool written = co_await write(std::move(response), *incoming);
    stop_listening();
    if (!written) break;
    if (proxied_) context_->table.assign(id_, "", std::chrono::steady_clock::now());
    if (!incoming->keep_alive) {
      co_await linger();
      break;
    }
  }
  stream_.close();
}

}  // namespace bahnwerk::server
