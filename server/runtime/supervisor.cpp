#include "server/runtime/supervisor.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstring>

namespace bahnwerk::server {
namespace {

/// Returns the bytes of the address; empty if `socket` names none.
std::string socket_address(std::string_view socket) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const bool abstract = socket.starts_with('@');
  if (!abstract && !socket.starts_with('/')) return {};
  if (socket.size() + (abstract ? 0 : 1) > sizeof address.sun_path) return {};
  std::copy(socket.begin(), socket.end(), address.sun_path);
  if (abstract) address.sun_path[0] = '\0';
  const char* bytes = reinterpret_cast<const char*>(&address);
  return {bytes, offsetof(sockaddr_un, sun_path) + socket.size() + (abstract ? 0 : 1)};
}

std::optional<long long> whole_number(const char* text) {
  if (!text) return std::nullopt;
  long long value = 0;
  const char* const end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

/// Returns the status in one line.
std::string one_line(std::string_view status) {
  std::string line(status);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

}  // namespace

Supervisor::Supervisor(std::string_view socket, std::chrono::microseconds watchdog)
    : address_(socket_address(socket)), watchdog_(watchdog) {
  // Kept open, so that signs of life need no further descriptor when all are taken.
  if (!address_.empty()) descriptor_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

Supervisor::~Supervisor() {
  if (present()) ::close(descriptor_);
}

std::optional<std::chrono::milliseconds> Supervisor::heartbeat() const {
  if (!present() || watchdog_.count() <= 0) return std::nullopt;
  const auto half = std::chrono::duration_cast<std::chrono::milliseconds>(watchdog_ / 2);
  return std::max(half, std::chrono::milliseconds(1));
}

bool Supervisor::ready(std::string_view status) const { return send("READY=1\nSTATUS=" + one_line(status)); }

bool Supervisor::stopping(std::string_view status, std::chrono::milliseconds within) const {
  const auto usec = std::chrono::duration_cast<std::chrono::microseconds>(within).count();
  return send("STOPPING=1\nSTATUS=" + one_line(status) + "\nEXTEND_TIMEOUT_USEC=" + std::to_string(usec));
}

bool Supervisor::alive() const { return send("WATCHDOG=1"); }

bool Supervisor::send(const std::string& message) const {
  if (!present()) return false;
  sockaddr_un address{};
  std::memcpy(&address, address_.data(), address_.size());
  return ::sendto(descriptor_, message.data(), message.size(), MSG_NOSIGNAL, reinterpret_cast<sockaddr*>(&address),
                  static_cast<socklen_t>(address_.size())) == static_cast<ssize_t>(message.size());
}

std::chrono::microseconds watchdog_interval(const char* usec, const char* watched, int pid) {
  const auto interval = whole_number(usec);
  if (!interval || *interval <= 0) return {};
  if (watched && whole_number(watched) != pid) return {};
  return std::chrono::microseconds(*interval);
}

}  // namespace bahnwerk::server
