#pragma once
/// A proxy before the PostgreSQL server of the test program, which parts a commit from its answer: the server has
/// carried it out, and the connection ends before the program hears of it. It can change what both say, too.
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <atomic>

#include "postgres_server.hpp"

namespace bahnwerk::server {

class PostgresWire {
 public:
  /// `url` is that of a database of PostgresServer.
  explicit PostgresWire(const std::string& url) {
    const std::size_t begin = url.find("host=") + 5, end = url.find('&', begin);
    server_ = address(url.substr(begin, end - begin));
    url_ = url.substr(0, begin) + folder_.path.string() + url.substr(end);
    const sockaddr_un own = address(folder_.path.string());
    listener_ = socket(AF_UNIX, SOCK_STREAM, 0);
    if (bind(listener_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0 || listen(listener_, 64) != 0)
      throw std::runtime_error("bind");
    thread_ = std::thread([this] { accept_all(); });
  }
  ~PostgresWire() {
    stop_ = true;
    thread_.join();
    for (std::thread& each : connections_) each.join();
    close(listener_);
  }
  PostgresWire(const PostgresWire&) = delete;
  PostgresWire& operator=(const PostgresWire&) = delete;

  const std::string& url() const { return url_; }
  /// The connection over which the next statement with this text is prepared ends when the server answers it.
  void part(const std::string& text) {
    const std::lock_guard lock(mutex_);
    text_ = text;
  }
  int parted() const { return parted_; }
  /// Has `to` said in place of `from`, which has its length, over connections made from now on.
  void replace(const std::string& from, const std::string& to) {
    if (from.size() != to.size()) throw std::runtime_error("another length");
    const std::lock_guard lock(mutex_);
    replaced_.emplace_back(from, to);
  }

 private:
  static sockaddr_un address(const std::string& folder) {
    sockaddr_un made{};
    made.sun_family = AF_UNIX;
    (folder + "/.s.PGSQL.5432").copy(made.sun_path, sizeof made.sun_path - 1);
    return made;
  }
  bool readable(int socket) const {
    pollfd waits{socket, POLLIN, 0};
    while (!stop_)
      if (poll(&waits, 1, 20) > 0) return true;
    return false;
  }
  void accept_all() {
    while (readable(listener_))
      connections_.emplace_back([this, client = accept(listener_, nullptr, nullptr)] { forward(client); });
  }
  bool wanted(std::string_view piece) {
    const std::lock_guard lock(mutex_);
    if (text_.empty() || piece.find(text_) == std::string_view::npos) return false;
    text_.clear();
    return true;
  }
  static void change(std::string_view text, char* piece,
                     const std::vector<std::pair<std::string, std::string>>& replaced) {
    for (const auto& [from, to] : replaced)
      for (std::size_t at = text.find(from); at != std::string_view::npos; at = text.find(from, at + 1))
        to.copy(piece + at, to.size());
  }
  void forward(int client) {
    const int server = socket(AF_UNIX, SOCK_STREAM, 0);
    bool open = connect(server, reinterpret_cast<const sockaddr*>(&server_), sizeof server_) == 0, parts = false;
    std::array<char, 1 << 16> piece{};
    const auto replaced = [this] {
      const std::lock_guard lock(mutex_);
      return replaced_;
    }();
    while (open && !stop_) {
      std::array<pollfd, 2> waits{pollfd{client, POLLIN, 0}, pollfd{server, POLLIN, 0}};
      if (poll(waits.data(), waits.size(), 20) <= 0) continue;
      for (std::size_t side = 0; side < 2 && open; ++side) {
        if (waits[side].revents == 0) continue;
        const ssize_t count = recv(waits[side].fd, piece.data(), piece.size(), 0);
        if (count > 0) change({piece.data(), static_cast<std::size_t>(count)}, piece.data(), replaced);
        if (side == 0 && count > 0) parts = parts || wanted({piece.data(), static_cast<std::size_t>(count)});
        if (side == 1 && parts) ++parted_;
        open = count > 0 && !(side == 1 && parts) &&
               send(waits[1 - side].fd, piece.data(), static_cast<std::size_t>(count), MSG_NOSIGNAL) == count;
      }
    }
    close(client);
    close(server);
  }

  TempFolder folder_;
  sockaddr_un server_{};
  std::string url_;
  int listener_ = -1;
  std::atomic<bool> stop_{false};
  std::atomic<int> parted_{0};
  std::mutex mutex_;
  std::string text_;
  std::vector<std::pair<std::string, std::string>> replaced_;
  std::thread thread_;
  std::vector<std::thread> connections_;  ///< used by thread_ alone until it has ended
};

}  // namespace bahnwerk::server
