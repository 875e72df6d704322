#pragma once
#include <string>

namespace bahnwerk::server {

/// Holds a file exclusively (flock) for the life of the object; the system lets go when the process dies, however it
/// dies.
class FileLock {
 public:
  /// Throws StoreError with a sentence for the operator: another process has it, no permission, no such directory.
  explicit FileLock(std::string path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace bahnwerk::server
