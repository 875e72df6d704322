#include "server/store/sqlite/writer.hpp"

#include <future>
#include <memory>

#include "server/runtime/clock.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t max_group = 512;
constexpr std::size_t page_size = 4096;
constexpr std::size_t comfortable =
    1 << 20;  // bytes free, of disk and file, from which on a full disk no longer is one
constexpr auto look_interval = std::chrono::seconds(1);

/// How long a transaction waits for another program's lock, and the next ones after it waited in vain.
constexpr std::chrono::milliseconds busy_patience{60'000}, short_patience{1'000};

bool says(const std::exception_ptr& error, bool StoreError::*what) {
  if (!error) return false;
  try {
    std::rethrow_exception(error);
  } catch (const StoreError& failure) {
    return failure.*what;
  } catch (...) {
    return false;
  }
}
bool says_full(const std::exception_ptr& error) { return says(error, &StoreError::full); }
bool says_busy(const std::exception_ptr& error) { return says(error, &StoreError::busy); }

}  // namespace

Writer::Writer(SqliteConnection& connection, Reserve& reserve, Hooks hooks)
    : connection_(connection), reserve_(reserve), hooks_(std::move(hooks)) {
  connection_.patience(busy_patience);
  full_ = reserve_.bytes() > 0;  // the disk counts as full until it was looked at
  thread_ = std::thread([this] { loop(); });
}

Writer::~Writer() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Writer::post(Work work, Done done, Bytes adds) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({std::move(work), std::move(done), adds});
  }
  wake_.notify_one();
}

void Writer::run(const Work& work, Bytes adds) { wait_for({work, nullptr, adds}); }

void Writer::outside(const Work& work) { wait_for({work, nullptr, frees, true}); }

void Writer::wait_for(Item item) {
  const auto promise = std::make_shared<std::promise<void>>();  // outlives whichever side is later
  item.done = [promise](const std::exception_ptr& error) {
    if (error)
      promise->set_exception(error);
    else
      promise->set_value();
  };
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(item));
  }
  wake_.notify_one();
  promise->get_future().get();
}

void Writer::loop() {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      const auto due = [&] { return stop_ || !waiting_.empty(); };
      if (full())
        wake_.wait_for(lock, look_interval, due);
      else
        wake_.wait(lock, due);
      if (stop_ && waiting_.empty()) return;
    }
    std::deque<Item> group = take();
    if (full()) look_for_space();
    if (!group.empty()) commit(group);
  }
}

std::deque<Writer::Item> Writer::take() {
  const std::lock_guard lock(mutex_);
  std::deque<Item> group;
  while (!waiting_.empty() && group.size() < max_group) {
    const bool apart = waiting_.front().outside;
    if (apart && !group.empty()) break;
    group.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
    if (apart) break;
  }
  return group;
}

std::exception_ptr Writer::try_group(std::deque<Item>& group) {
  const auto start = std::chrono::steady_clock::now();
  const bool transaction = !group.front().outside;
  hooks_.begin();
  try {
    if (transaction) connection_.execute("BEGIN IMMEDIATE");
    Bytes adds = 0;
    for (Item& item : group) {
      item.work(connection_);
      adds += item.adds;
    }
    if (transaction) {
      secure(adds);
      connection_.execute("COMMIT");
    }
  } catch (...) {
    const auto error = std::current_exception();
    connection_.rollback();
    allocated_ = 0;  // a checkpoint cuts off what was allocated for it
    if (says_busy(error)) connection_.patience(short_patience);
    return error;
  }
  connection_.patience(busy_patience);
  ++commits_;
  hooks_.committed(seconds_since(start), group.size());
  return nullptr;
}

// Pages that a transaction adds are in the log first and reach the file at a checkpoint. They get their place on the
// disk before the commit: otherwise a log full of them could not be emptied on a full disk, and would keep the space
// that deleting needs.
void Writer::secure(Bytes adds) {
  const auto bytes = std::int64_t{connection_.query("PRAGMA page_count").one_int()} * std::int64_t{page_size};
  if (bytes <= allocated_) return;
  if (connection_.allocate(bytes))
    allocated_ = bytes;
  else if (adds > 0)
    throw StoreError("no space left for the store", true);
}

void Writer::commit(std::deque<Item>& group) {
  std::exception_ptr error;
  if (group.size() > 1) {
    Bytes adds = 0;
    for (const Item& item : group) adds += item.adds;
    const bool room = room_for(adds) == Room::enough;
    if (room) error = try_group(group);
    if (!room || (error && !says_busy(error))) {  // one bad work must not fail its neighbours
      for (Item& item : group) {
        std::deque<Item> one;
        one.push_back(std::move(item));
        commit(one);
      }
      return;
    }
  } else {
    error = alone(group);
  }
  for (Item& item : group) {
    if (item.done) item.done(error);
    item = {};  // the item's captures are destroyed before the next group is awaited
  }
}

std::exception_ptr Writer::alone(std::deque<Item>& one) {
  const Bytes adds = one.front().adds;
  Room room = room_for(adds);
  if (room != Room::enough) {
    checkpoint();  // the log's own space may be all that is missing
    room = room_for(adds);
  }
  if (room == Room::none) {
    full_ = true;
    return std::make_exception_ptr(StoreError("no space left for the store", true));
  }
  if (room == Room::with_reserve) reserve_.give_up();
  std::exception_ptr error = try_group(one);
  if (says_full(error)) {
    full_ = true;
    if (adds == frees && reserve_.held()) {
      reserve_.give_up();
      error = try_group(one);
    }
  }
  if (!error && adds > 0) full_ = false;
  if (!reserve_.held()) {
    checkpoint();
    reserve_.take();
  }
  return error;
}

Writer::Room Writer::room_for(Bytes bytes) {
  if (bytes == 0) return Room::enough;
  const std::size_t space = reserve_.free_space();
  if (reserve_.held() && space >= 2 * bytes) return Room::enough;
  // Pages that deleted jobs left are used again: then the file does not grow, and the log alone needs space.
  const bool inside = free_pages() > bytes / page_size + 16;
  if (reserve_.held() && inside && space >= bytes + bytes / 8) return Room::enough;
  return reserve_.held() && inside && bytes < reserve_.bytes() / 2 ? Room::with_reserve : Room::none;
}

std::size_t Writer::free_pages() noexcept {
  try {
    return static_cast<std::size_t>(connection_.query("PRAGMA freelist_count").one_int());
  } catch (...) {  // a file that cannot be read will say so where it matters
    return 0;
  }
}

void Writer::checkpoint() noexcept {
  const auto before = connection_.patience(short_patience);
  try {
    connection_.execute("PRAGMA wal_checkpoint(TRUNCATE)");
  } catch (...) {  // a disk too full even for that, or another reader: the log keeps what it has
  }
  connection_.patience(before);
}

void Writer::look_for_space() {
  if (!reserve_.held()) checkpoint();
  if (reserve_.take() && reserve_.free_space() + free_pages() * page_size >= comfortable) full_ = false;
}

}  // namespace bahnwerk::server
