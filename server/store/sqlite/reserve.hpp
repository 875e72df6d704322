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
  /// Does not allocate. A reserve of 0 bytes always counts as held.
  Reserve(std::string path, std::size_t bytes) : path_(std::move(path)), bytes_(bytes), held_(bytes == 0) {}

  bool take();  ///< allocates the reserve; returns false, without allocating, if there is too little space
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
