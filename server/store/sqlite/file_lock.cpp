#include "server/store/sqlite/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "server/store/store.hpp"

namespace bahnwerk::server {

FileLock::FileLock(std::string path, Holder holder) {
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor_ < 0) throw StoreError("cannot open " + path + ": " + std::strerror(errno), errno == ENOSPC);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    char owner[32] = {};
    const ssize_t size = holder == Holder::written ? ::read(descriptor_, owner, sizeof owner - 1) : 0;
    ::close(descriptor_);
    const std::string who = size > 0 ? " (process " + std::string(owner, owner + size) + ")" : "";
    throw StoreError("another bahnwerk" + who + " uses this store; one process owns it (" + path + " is locked)",
                     false);
  }
  if (holder == Holder::unnamed) return;
  // The holder's process id is written for the message above; the lock does not depend on it.
  const std::string pid = std::to_string(::getpid());
  if (::ftruncate(descriptor_, 0) == 0) (void)!::write(descriptor_, pid.data(), pid.size());
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace bahnwerk::server
