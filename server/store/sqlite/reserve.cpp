#include "server/store/sqlite/reserve.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <filesystem>
#include <limits>

namespace bahnwerk::server {

bool Reserve::take() {
  if (held_) return true;
  const int file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return false;
  // posix_fallocate writes zeros where the file system cannot allocate otherwise.
  const bool allocated = ::posix_fallocate(file, 0, static_cast<off_t>(bytes_)) == 0;
  // This removes the rest of a larger reserve of an earlier start, or what a nearly full disk could give.
  const bool cut = ::ftruncate(file, allocated ? static_cast<off_t>(bytes_) : 0) == 0;
  ::close(file);
  held_ = allocated && cut;
  return held_;
}

void Reserve::give_up() {
  if (bytes_ == 0) return;
  // The file stays: making one again would need space in the directory.
  if (::truncate(path_.c_str(), 0) == 0) held_ = false;
}

std::size_t Reserve::free_space() const {
  struct statvfs space {};
  const std::string folder = std::filesystem::path(path_).parent_path().string();
  if (::statvfs(folder.empty() ? "." : folder.c_str(), &space) != 0) return std::numeric_limits<std::size_t>::max();
  return static_cast<std::size_t>(space.f_bavail) * space.f_frsize;
}

}  // namespace bahnwerk::server
