#include "server/http/listener.hpp"

#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/basic_socket_acceptor.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "server/http/connection.hpp"
#include "server/http/endpoints.hpp"
#include "server/http/tls.hpp"
#include "server/runtime/log.hpp"

namespace bahnwerk::server {
namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr auto tuple_awaitable = asio::as_tuple(asio::use_awaitable);

/// The open connections, so that one can be closed and an orderly end can wait for all.
class Open {
 public:
  std::size_t add(ConnectionTable::Id id, const std::shared_ptr<Connection>& connection) {
    const std::lock_guard lock(mutex_);
    list_.emplace(id, connection);
    return list_.size();
  }
  std::size_t remove(ConnectionTable::Id id) {
    const std::lock_guard lock(mutex_);
    list_.erase(id);
    if (list_.empty()) empty_.notify_all();
    return list_.size();
  }
  void cut(ConnectionTable::Id id) {
    const std::lock_guard lock(mutex_);
    if (const auto found = list_.find(id); found != list_.end())
      if (const auto alive = found->second.lock()) alive->cut(Connection::Cut::crowded);
  }
  void finish_listening(ConnectionTable::Id id) {
    const std::lock_guard lock(mutex_);
    if (const auto found = list_.find(id); found != list_.end())
      if (const auto alive = found->second.lock()) alive->finish_listening();
  }
  bool drain(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    for (const auto& [id, connection] : list_)
      if (const auto alive = connection.lock()) alive->cut(Connection::Cut::closing);
    return empty_.wait_for(lock, patience, [&] { return list_.empty(); });
  }

 private:
  std::mutex mutex_;
  std::condition_variable empty_;
  std::map<ConnectionTable::Id, std::weak_ptr<Connection>> list_;
};

struct Address {
  std::string host, port;
};
Address split_address(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size())
    throw std::runtime_error("'" + text +
                             "' is no address to listen on; expected HOST:PORT, for example 127.0.0.1:8080");
  std::string host = text.substr(0, colon);
  if (host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  const std::string port = text.substr(colon + 1);
  if (port.find_first_not_of("0123456789") != std::string::npos || port.size() > 5 || std::stoi(port) > 65535)
    throw std::runtime_error("'" + port + "' is no port; expected 0 to 65535");
  return {host, port};
}

}  // namespace

struct Listener::State {
  asio::io_context io;
  asio::basic_socket_acceptor<asio::generic::stream_protocol> acceptor{asio::make_strand(io)};
  std::string socket_path;  ///< path of a Unix socket; empty: TCP
  TlsFiles tls_files;
  std::mutex tls_mutex;
  std::shared_ptr<asio::ssl::context> tls;  ///< settings of new connections; nullptr: plain HTTP
  std::shared_ptr<ConnectionContext> context;
  Open open;
  std::vector<std::thread> threads;

  /// A handler that finds no memory must not end the process.
  void run() {
    for (;;) {
      try {
        io.run();
        return;
      } catch (const std::exception& error) {
        log::error("socket_thread_failed", {{"detail", error.what()}});
      }
    }
  }

  asio::awaitable<void> accept() {
    asio::steady_timer pause(acceptor.get_executor());
    while (!context->closing) {
      auto [error, socket] = co_await acceptor.async_accept(asio::make_strand(io), tuple_awaitable);
      if (error == asio::error::operation_aborted || context->closing) break;
      if (error) {  // descriptors have run out, mostly: the pause lets some close
        log::warn("accept_failed", {{"detail", error.message()}});
        if (const auto idle = context->table.longest_waiting(std::chrono::steady_clock::now())) open.cut(*idle);
        pause.expires_after(std::chrono::milliseconds(100));
        co_await pause.async_wait(tuple_awaitable);
        continue;
      }
      spawn(std::move(socket));
    }
  }

  std::shared_ptr<asio::ssl::context> current_tls() {
    const std::lock_guard lock(tls_mutex);
    return tls;
  }

  void spawn(ClientStream::Socket socket) {
    const std::string peer = peer_address(socket);
    const std::string key = context->hooks.proxies.contain(peer) ? "" : address_key(peer);
    const auto admission = context->table.admit(key, std::chrono::steady_clock::now());
    if (admission.leave) open.cut(*admission.leave);
    if (admission.place == ConnectionTable::Place::none) return;  // even a polite refusal has its limit
    const bool spare = admission.place == ConnectionTable::Place::spare;
    const auto executor = socket.get_executor();
    const auto connection =
        std::make_shared<Connection>(std::move(socket), current_tls(), context, admission.id, spare);
    context->hooks.connections(open.add(admission.id, connection));
    asio::co_spawn(executor, run(connection, admission.id), asio::detached);
  }

  asio::awaitable<void> run(std::shared_ptr<Connection> connection, ConnectionTable::Id id) {
    try {
      co_await connection->serve();
    } catch (const std::exception& error) {
      log::error("connection_failed", {{"detail", error.what()}});
    }
    context->table.remove(id);
    context->hooks.connections(open.remove(id));
  }
};

Listener::Listener(Limits limits, ListenerHooks hooks) : state_(std::make_unique<State>()) {
  state_->context = std::make_shared<ConnectionContext>(limits);
  state_->context->hooks = std::move(hooks);
  state_->context->finish = [state = state_.get()](ConnectionTable::Id id) { state->open.finish_listening(id); };
}

Listener::~Listener() { stop(std::chrono::milliseconds(0)); }

void Listener::open(const std::string& address, const TlsFiles& tls, unsigned mode) {
  state_->tls_files = tls;
  state_->tls = make_tls(tls);
  constexpr std::string_view local = "unix:";
  address.starts_with(local) ? open_local(address.substr(local.size()), mode) : open_tcp(address);
}

void Listener::open_local(const std::string& path, unsigned mode) {
  if (path.empty() || path.size() >= sizeof(sockaddr_un::sun_path))
    throw std::runtime_error("'" + path + "' is no path of a Unix socket; expected unix:/PATH of at most 107 bytes");
  const asio::local::stream_protocol::endpoint endpoint(path);
  boost::system::error_code error;
  struct stat found {};
  if (::lstat(path.c_str(), &found) == 0) {
    if (!S_ISSOCK(found.st_mode)) throw std::runtime_error(path + " exists and is no socket");
    asio::local::stream_protocol::socket probe(state_->io);
    probe.connect(endpoint, error);
    if (error != asio::error::connection_refused) throw std::runtime_error(path + " is taken by another program");
    ::unlink(path.c_str());  // its process has ended
  }
  auto& acceptor = state_->acceptor;
  acceptor.open(endpoint.protocol());
  const mode_t before = ::umask(0177);  // nobody else connects before it has its permissions
  acceptor.bind(endpoint, error);
  ::umask(before);
  if (!error && ::chmod(path.c_str(), mode) != 0) error.assign(errno, boost::system::system_category());
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) throw std::runtime_error("cannot listen on " + path + ": " + error.message());
  state_->socket_path = path;
}

void Listener::open_tcp(const std::string& address) {
  const Address where = split_address(address);
  boost::system::error_code error;
  tcp::resolver resolver(state_->io);
  const auto found =
      resolver.resolve(where.host, where.port, tcp::resolver::passive | tcp::resolver::numeric_service, error);
  if (error || found.empty())
    throw std::runtime_error("cannot find the address '" + where.host + "': " + error.message());
  const tcp::endpoint endpoint = found.begin()->endpoint();
  const auto check = [&](const char* what) {
    if (!error) return;
    if (error == asio::error::address_in_use)
      throw std::runtime_error(address + " is taken by another program; choose another with --listen HOST:PORT");
    if (error == asio::error::access_denied)
      throw std::runtime_error("no permission to listen on " + address + "; ports below 1024 need a privileged user");
    throw std::runtime_error("cannot " + std::string(what) + " " + address + ": " + error.message());
  };
  auto& acceptor = state_->acceptor;
  acceptor.open(endpoint.protocol(), error);
  check("open");
  acceptor.set_option(asio::socket_base::reuse_address(true), error);
  acceptor.bind(endpoint, error);
  check("bind");
  acceptor.listen(asio::socket_base::max_listen_connections, error);
  check("listen on");
}

std::string Listener::address() const {
  if (!state_->socket_path.empty()) return "unix:" + state_->socket_path;
  const auto endpoint = tcp_endpoint(state_->acceptor.local_endpoint()).value();
  const std::string host = endpoint.address().to_string();
  return (endpoint.address().is_v6() ? "[" + host + "]" : host) + ":" + std::to_string(endpoint.port());
}

bool Listener::reachable() const {
  const auto endpoint = tcp_endpoint(state_->acceptor.local_endpoint());
  return endpoint && !endpoint->address().is_loopback();
}

void Listener::reload_certificate() {
  auto tls = make_tls(state_->tls_files);
  const std::lock_guard lock(state_->tls_mutex);
  state_->tls.swap(tls);
}

void Listener::start(unsigned threads) {
  asio::co_spawn(state_->acceptor.get_executor(), state_->accept(), asio::detached);
  for (unsigned i = 0; i < threads; ++i) state_->threads.emplace_back([this] { state_->run(); });
}

void Listener::post(std::function<void()> work) { asio::post(state_->io, std::move(work)); }

bool Listener::stop(std::chrono::milliseconds patience) {
  if (state_->threads.empty()) return true;
  state_->context->closing = true;
  asio::post(state_->acceptor.get_executor(), [this] {
    boost::system::error_code ignored;
    state_->acceptor.close(ignored);
  });
  const bool finished = state_->open.drain(patience);
  state_->io.stop();
  for (auto& thread : state_->threads) thread.join();
  state_->threads.clear();
  if (!state_->socket_path.empty()) ::unlink(state_->socket_path.c_str());
  return finished;
}

}  // namespace bahnwerk::server
