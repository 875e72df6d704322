#pragma once
#include <string>

namespace bahnwerk::server {

/// Locks a file exclusively (flock) for the life of the object; the system releases the lock when the process dies in
/// any manner.
class FileLock {
 public:
  /// Whether the holder's process id is written into the file, for the message of another one.
  enum class Holder { written, unnamed };
  /// Creates the file if it is missing, for its owner alone. Throws StoreError with a sentence for the operator:
  /// another process has the lock, no permission, no such directory.
  explicit FileLock(std::string path, Holder holder = Holder::written);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace bahnwerk::server
