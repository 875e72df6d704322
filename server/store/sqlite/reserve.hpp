#pragma once
/// Disk space set aside beside the database, so that a full disk can be emptied: deleting, cancelling and ending a job
/// write to the log before they free anything.
#include <atomic>
#include <cstddef>
#include <string>

namespace bahnwerk::server {

/// A file of `bytes` really allocated bytes. Given up when the disk is full, taken again as soon as there is room;
/// while it is not held the disk counts as full. Used by the writer's thread; held() from any.
class Reserve {
 public:
  /// 0 bytes: nothing is set aside, and it always counts as held. Does not take it yet.
  Reserve(std::string path, std::size_t bytes) : path_(std::move(path)), bytes_(bytes), held_(bytes == 0) {}

  bool take();  ///< false: there is no room for all of it; then none of it is kept
  void give_up();
  bool held() const { return held_; }
  std::size_t bytes() const { return bytes_; }
  /// Bytes that this process may still write to the file system.
  std::size_t free_space() const;

 private:
  const std::string path_;
  const std::size_t bytes_;
  std::atomic<bool> held_;
};

}  // namespace bahnwerk::server
