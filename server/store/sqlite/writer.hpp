#pragma once
/// Group commit: one thread owns the writing connection; all works that wait when it is free share one transaction.
/// A database that another program has locked is waited for a minute; then all works that wait fail. Works never
/// commit: what cannot run inside a transaction uses `outside`.
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "server/store/sqlite/connection.hpp"
#include "server/store/sqlite/reserve.hpp"

namespace bahnwerk::server {

class Writer {
 public:
  /// A work may run more than once: when a group fails, each of its works is tried alone, in a transaction of its own.
  using Work = std::function<void(SqliteConnection&)>;
  /// Receives nullptr once after the commit, or the error; it runs on the writer's thread, so it must be quick.
  using Done = std::function<void(std::exception_ptr)>;
  /// Receives every commit: seconds, works in it.
  using Observer = std::function<void(double, std::size_t)>;
  /// Callbacks on the writer's thread: before a transaction begins, and after it was committed, before its works' Done.
  struct Hooks {
    std::function<void()> begin;
    Observer committed;
  };
  /// Approximate number of bytes that a work adds to the database. A work that adds none (deletes, cancels, ends a job)
  /// may use the reserve when the disk is full. A work that adds some is refused while there is less than twice that
  /// room, once for the log and once for the file: committed data can then always be moved into the file.
  using Bytes = std::size_t;
  static constexpr Bytes frees = 0, row = 4096;

  Writer(SqliteConnection& connection, Reserve& reserve, Hooks hooks);
  ~Writer();  ///< runs the posted works, then ends
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void post(Work work, Done done, Bytes adds);
  void run(const Work& work, Bytes adds = frees);  ///< posts and waits; rethrows
  /// Runs a work that makes its own transactions, or must not be in one (migrations, checkpoints): in its turn, alone,
  /// without a transaction around it. It may run twice when the disk is full.
  void outside(const Work& work);

  /// Returns whether the disk was full at the last write, or the reserve is used up. It becomes false within about a
  /// second after there is space.
  bool full() const { return full_ || !reserve_.held(); }
  /// Increases with every commit, before it is reported: a value read at one count is current as long as the count is
  /// unchanged.
  std::uint64_t commits() const { return commits_; }

 private:
  struct Item {
    Work work;
    Done done;
    Bytes adds = 0;
    bool outside = false;  ///< whether the work runs outside of any transaction, as a group of its own
  };
  enum class Room { enough, with_reserve, none };
  void loop();
  void wait_for(Item item);
  std::deque<Item> take();
  void commit(std::deque<Item>& group);
  std::exception_ptr try_group(std::deque<Item>& group);
  std::exception_ptr alone(std::deque<Item>& one);
  Room room_for(Bytes bytes);
  void secure(Bytes adds);
  std::size_t free_pages() noexcept;
  void checkpoint() noexcept;
  void look_for_space();

  SqliteConnection& connection_;
  Reserve& reserve_;
  Hooks hooks_;
  std::int64_t allocated_ = 0;  ///< bytes of the file known to be allocated on the disk
  std::atomic<bool> full_{false};
  std::atomic<std::uint64_t> commits_{0};
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Item> waiting_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace bahnwerk::server
