#pragma once
/// A client's connection: a coroutine that reads a request, awaits its answer, writes it, and repeats. Only
/// listener.cpp and the connection's two sources include this (Beast is slow to compile).
#include <atomic>
#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <functional>
#include <memory>
#include <optional>

#include "server/http/body_budget.hpp"
#include "server/http/client_stream.hpp"
#include "server/http/connection_table.hpp"
#include "server/http/listener.hpp"
#include "server/http/message.hpp"

namespace bahnwerk::server {

/// Objects shared by all connections of a listener.
struct ConnectionContext {
  explicit ConnectionContext(const Limits& l)
      : limits(l),
        bodies(std::make_shared<BodyBudget>(l.max_bodies)),
        table({.most = l.max_connections,
               .max_per_address = l.max_per_address,
               .spare = l.spare_connections,
               .stalled = l.stall_timeout}) {}
  Limits limits;
  ListenerHooks hooks;
  std::shared_ptr<BodyBudget> bodies;
  ConnectionTable table;
  std::function<void(ConnectionTable::Id)> finish;  ///< ends the answer of another connection's listener
  std::atomic<bool> closing{false};
};

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  enum class Cut { none, timeout, crowded, closing };
  /// A `spare` connection serves one request, for health or readiness, and answers 503 to any other.
  Connection(ClientStream::Socket socket, std::shared_ptr<boost::asio::ssl::context> tls,
             std::shared_ptr<ConnectionContext> context, ConnectionTable::Id id, bool spare);

  boost::asio::awaitable<void> serve();  ///< serves requests until the client or a fault ends the connection
  /// Closes the connection unless a request is being answered; a client in the middle of a request gets a 408. From any
  /// thread.
  void cut(Cut why);
  void finish_listening();  ///< ends the answer that waits for something to happen, if there is one. From any thread.

 private:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t max_read = 64 << 10;  ///< bytes that are read at once
  static constexpr std::size_t bytes_per_ms = 100;   ///< 100 kB/s: what a slow client has to manage
  /// A request as read, or the answer to a broken one.
  struct Incoming {
    RequestPtr request = std::make_shared<Request>();
    bool keep_alive = false;
    bool http_1_0 = false;
  };
  boost::asio::awaitable<std::optional<Incoming>> read();
  boost::asio::awaitable<boost::system::error_code> read_some();
  template <class Parser>
  boost::asio::awaitable<boost::system::error_code> read_header(Parser& parser);
  template <class Parser>
  boost::asio::awaitable<boost::system::error_code> read_body(Parser& parser, Request& request);
  boost::asio::awaitable<Response> answer(RequestPtr request);
  boost::asio::awaitable<bool> write(Response response, const Incoming& incoming);
  boost::asio::awaitable<bool> write_stream(Response response, const Incoming& incoming);
  /// Counts as a listener from now on; `finish` ends the answer, when the client closes its side or others need the
  /// connection.
  void listen(std::function<void()> finish);
  void finish_when_gone(std::uint64_t answer, bool asked_again);
  bool client_left();
  void stop_listening();
  boost::asio::awaitable<bool> write_raw(std::string text);
  boost::asio::awaitable<void> linger();
  boost::asio::awaitable<bool> greet();  ///< the handshake of TLS, if there is TLS
  void expire(std::chrono::milliseconds base, std::size_t bytes);
  void read_until(Time until);  ///< reading is cut at that time
  void stop_clock();
  void stop_reading(Cut why);
  void enter(ConnectionTable::Phase phase, Time since = std::chrono::steady_clock::now());

  ClientStream stream_;
  std::shared_ptr<ConnectionContext> context_;
  boost::beast::flat_buffer buffer_;
  boost::asio::steady_timer timer_;
  std::uint64_t turn_ = 0;  ///< count of timer settings: an expiry of an earlier setting is ignored
  std::string peer_;
  const ConnectionTable::Id id_;
  const bool spare_;
  const Time connected_ = std::chrono::steady_clock::now();
  bool proxied_ = false;  ///< whether a trusted proxy asks, for clients whose addresses it tells
  bool reading_ = false, first_ = true;
  bool lingering_ = false;        ///< the last answer is written, and the client has not closed its side yet
  bool leaving_ = false;          ///< the current request is the last
  std::function<void()> finish_;  ///< ends the answer that waits for something to happen
  std::uint64_t answer_ = 0;      ///< number of the current answer
  Cut cut_ = Cut::none;
};

}  // namespace bahnwerk::server
