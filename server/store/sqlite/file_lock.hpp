#pragma once
#include <string>

namespace bahnwerk::server {

/// Locks a file exclusively (flock) for the life of the object; the system releases the lock when the process dies in
/// any manner.
class FileLock {
 public:
  /// Throws StoreError with a sentence for the operator: another process has the lock, no permission, no such
  /// directory.
  explicit FileLock(std::string path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace bahnwerk::server
