#pragma once
/// A file system for SQLite that fails one of its calls, once. It stands before the default one and counts the calls
/// that open, write, cut, synchronise or lock a file, of any thread.
#include <sqlite3.h>

#include <atomic>
#include <cstring>
#include <stdexcept>

namespace bahnwerk::server::test {

/// While the object lives SQLite's files are opened by it. Only one exists at a time.
class FailingVfs {
 public:
  FailingVfs() {
    real() = sqlite3_vfs_find(nullptr);
    vfs_ = *real();
    vfs_.zName = "failing";
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + real()->szOsFile;
    vfs_.xOpen = open;
    if (sqlite3_vfs_register(&vfs_, 1) != SQLITE_OK) throw std::runtime_error("sqlite3_vfs_register");
  }
  ~FailingVfs() {
    sqlite3_vfs_unregister(&vfs_);
    sqlite3_vfs_register(real(), 1);
  }
  FailingVfs(const FailingVfs&) = delete;
  FailingVfs& operator=(const FailingVfs&) = delete;

  /// The `call`-th call from now on fails; 0: none.
  static void fail_at(int call) {
    calls() = 0;
    failing() = call;
  }
  static bool failed() { return failing() > 0 && calls() >= failing(); }

 private:
  struct File {
    sqlite3_file base;
    sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
    static sqlite3_file* real(sqlite3_file* file) { return reinterpret_cast<File*>(file)->real(); }
  };

  static sqlite3_vfs*& real() {
    static sqlite3_vfs* vfs = nullptr;
    return vfs;
  }
  static std::atomic<int>& calls() {
    static std::atomic<int> count{0};
    return count;
  }
  static std::atomic<int>& failing() {
    static std::atomic<int> call{0};
    return call;
  }
  static bool fails() { return ++calls() == failing(); }

  static int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* given) {
    file->pMethods = nullptr;
    if (fails()) return SQLITE_CANTOPEN;
    const int result = real()->xOpen(real(), name, File::real(file), flags, given);
    if (result == SQLITE_OK) file->pMethods = &methods();
    return result;
  }
  /// Writes the first half before it fails, as a disk may.
  static int write(sqlite3_file* file, const void* data, int size, sqlite3_int64 at) {
    sqlite3_file* to = File::real(file);
    if (!fails()) return to->pMethods->xWrite(to, data, size, at);
    to->pMethods->xWrite(to, data, size / 2, at);
    return SQLITE_IOERR_WRITE;
  }
  static int truncate(sqlite3_file* file, sqlite3_int64 size) {
    return fails() ? SQLITE_IOERR_TRUNCATE : File::real(file)->pMethods->xTruncate(File::real(file), size);
  }
  /// Nothing is synchronised: the machine does not stop during a test.
  static int sync(sqlite3_file*, int) { return fails() ? SQLITE_IOERR_FSYNC : SQLITE_OK; }
  static int lock(sqlite3_file* file, int level) {
    return fails() ? SQLITE_IOERR_LOCK : File::real(file)->pMethods->xLock(File::real(file), level);
  }
  static int map(sqlite3_file* file, int page, int size, int extend, void volatile** to) {
    if (fails()) return SQLITE_IOERR_SHMMAP;
    return File::real(file)->pMethods->xShmMap(File::real(file), page, size, extend, to);
  }
  static int lock_map(sqlite3_file* file, int offset, int count, int flags) {
    // Giving a lock back never fails.
    if ((flags & SQLITE_SHM_LOCK) != 0 && fails()) return SQLITE_IOERR_SHMLOCK;
    return File::real(file)->pMethods->xShmLock(File::real(file), offset, count, flags);
  }

  static const sqlite3_io_methods& methods() {
    static const sqlite3_io_methods all = [] {
      sqlite3_io_methods m;
      std::memset(&m, 0, sizeof m);
      m.iVersion = 2;
      m.xClose = [](sqlite3_file* f) { return File::real(f)->pMethods->xClose(File::real(f)); };
      m.xRead = [](sqlite3_file* f, void* data, int size, sqlite3_int64 at) {
        return File::real(f)->pMethods->xRead(File::real(f), data, size, at);
      };
      m.xWrite = write;
      m.xTruncate = truncate;
      m.xSync = sync;
      m.xFileSize = [](sqlite3_file* f, sqlite3_int64* size) {
        return File::real(f)->pMethods->xFileSize(File::real(f), size);
      };
      m.xLock = lock;
      m.xUnlock = [](sqlite3_file* f, int level) { return File::real(f)->pMethods->xUnlock(File::real(f), level); };
      m.xCheckReservedLock = [](sqlite3_file* f, int* held) {
        return File::real(f)->pMethods->xCheckReservedLock(File::real(f), held);
      };
      m.xFileControl = [](sqlite3_file* f, int op, void* arg) {
        return File::real(f)->pMethods->xFileControl(File::real(f), op, arg);
      };
      m.xSectorSize = [](sqlite3_file* f) { return File::real(f)->pMethods->xSectorSize(File::real(f)); };
      m.xDeviceCharacteristics = [](sqlite3_file* f) {
        return File::real(f)->pMethods->xDeviceCharacteristics(File::real(f));
      };
      m.xShmMap = map;
      m.xShmLock = lock_map;
      m.xShmBarrier = [](sqlite3_file* f) { File::real(f)->pMethods->xShmBarrier(File::real(f)); };
      m.xShmUnmap = [](sqlite3_file* f, int remove) {
        return File::real(f)->pMethods->xShmUnmap(File::real(f), remove);
      };
      return m;
    }();
    return all;
  }

  sqlite3_vfs vfs_;
};

}  // namespace bahnwerk::server::test
