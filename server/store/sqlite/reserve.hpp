#pragma once
/// Disk space set aside beside the database, so that a full disk can be emptied: deleting, cancelling and ending a job
/// write to the log before they free space.
#include <atomic>
#include <cstddef>
#include <string>

namespace bahnwerk::server {

/// A file of `bytes` allocated bytes. It is released when the disk is full, and allocated again as soon as there is
/// room; without it the disk counts as full. Used by the writer's thread; held() from any.
class Reserve {
 public:
  /// With 0 bytes nothing is set aside, and it always counts as held. The constructor does not allocate.
  Reserve(std::string path, std::size_t bytes) : path_(std::move(path)), bytes_(bytes), held_(bytes == 0) {}

  bool take();  ///< false: there is no room for all of it; then nothing is allocated
  void give_up();
  bool held() const { return held_; }
  std::size_t bytes() const { return bytes_; }
  /// Returns the bytes that this process may still write to the file system.
  std::size_t free_space() const;

 private:
  const std::string path_;
  const std::size_t bytes_;
  std::atomic<bool> held_;
};

}  // namespace bahnwerk::server
