/// PostgresStore: posted jobs. Threads take what waits and store it together, so that waiting posts share
/// a commit.
#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "server/runtime/clock.hpp"
#include "server/store/codec.hpp"
#include "server/store/postgres/post.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t posts_at_once = 64;
/// A document that is larger is stored by a statement of its own, which does not copy it.
constexpr std::size_t large_bytes = 64 << 10;
/// Documents of a statement, and of a transaction that may take longer than the others.
constexpr std::size_t statement_bytes = 256 << 10, lengthy_bytes = 1 << 20;
/// Time for which a number of queued jobs that was read is taken for granted, with the own posts since then, by posts
/// that it admits.
constexpr std::chrono::seconds counted_for{1};
/// Between the tags of a job: no tag has it.
constexpr char tag_end = '\x1f';

/// Stores posts, whose values are arrays: the server begins a statement once for all of them, which takes it longer
/// than their rows. Keys are inserted first: of two posts with one key at once, the second one waits for the first and
/// then inserts nothing. An id that exists was inserted by the same post, whose answer was lost. Isolation: READ
/// COMMITTED. Transactions at once may give one turn twice, which is no harm. Owners take turns as in the SQLite store
/// [start-time fair queueing: Goyal, Vin, Cheng 1996]. Returns the ids of the jobs that are new. $17 is a large
/// document, in place of the missing one.
constexpr auto insert_jobs =
    "WITH post AS MATERIALIZED (SELECT * FROM unnest($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12, $13, $14, $15, "
    "$16) WITH ORDINALITY AS p (id, kind, name, reference, owner, tags, rank, deadline, time_budget, created_at, "
    "callback, callback_secret, callback_receiver, key, body_hash, document, number)), "
    "kept AS (INSERT INTO idempotency_keys (owner, key, body_hash, id) SELECT coalesce(owner, ''), key, body_hash, id "
    "FROM post WHERE key IS NOT NULL ORDER BY number ON CONFLICT DO NOTHING RETURNING id), "
    "job AS (INSERT INTO jobs (id, kind, name, reference, owner, tags, rank, turn, needs, deadline, time_budget, "
    "state, "
    "created_at, callback, callback_secret, callback_receiver) "
    "SELECT id, kind, name, reference, owner, string_to_array(tags, E'\\x1f'), rank, CASE WHEN owner IS NULL THEN 0 "
    "ELSE "
    "greatest(coalesce((SELECT max(turn) + 1 FROM jobs AS j WHERE state = 'queued' AND j.owner = post.owner AND j.rank "
    "= "
    "post.rank), 0), coalesce((SELECT min(turn) FROM jobs AS j WHERE state = 'queued' AND j.rank = post.rank), 0)) + "
    "row_number() OVER (PARTITION BY owner, rank ORDER BY number) - 1 END, $18, deadline, time_budget, 'queued', "
    "created_at, callback, callback_secret, callback_receiver FROM post WHERE key IS NULL OR EXISTS (SELECT FROM kept "
    "WHERE kept.id = post.id) ORDER BY number ON CONFLICT (id) DO NOTHING RETURNING id, owner, tags), "
    "spec AS (INSERT INTO specs (id, document, checked) SELECT id, coalesce(document, $17), id <> ALL ($19) FROM post "
    "WHERE id IN (SELECT id FROM job)), "
    "tagged AS (INSERT INTO job_tags (owner, tag, id) SELECT who.owner, tag, job.id FROM job, unnest(job.tags) AS tag, "
    "LATERAL (SELECT '' AS owner UNION SELECT job.owner WHERE job.owner IS NOT NULL) AS who), "
    "told AS (INSERT INTO changes (id, owner) SELECT id, owner FROM job), "
    "counted AS (INSERT INTO count_deltas (state, owner, jobs) SELECT 'queued', coalesce(owner, ''), count(*) FROM job "
    "GROUP BY owner) SELECT id FROM job";

/// By its estimates of short arrays the server would plan the statement again for each group: 0.5 ms, where four posts
/// take 0.2 ms.
constexpr auto planned_once = "SELECT set_config('plan_cache_mode', 'force_generic_plan', true)";

using KeyName = std::pair<std::string, std::string>;  ///< owner and key

}  // namespace

void PostgresStore::insert(NewJob job, std::function<void(Inserted, std::exception_ptr)> done) {
  Post post;
  post.packed = pack_text(job.request.document);
  job.request.document = std::string();
  post.job = std::move(job);
  post.done = std::move(done);
  {
    const std::lock_guard lock(ids_mutex_);
    post.id = ids_.next(post.job.now);
  }
  {
    const std::lock_guard lock(mutex_);
    posts_.push_back(std::move(post));
  }
  wake_.notify_one();
}

void PostgresStore::write() {
  for (;;) {
    std::vector<Post> posts;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stop_ || !posts_.empty(); });
      if (posts_.empty()) return;
      while (!posts_.empty() && posts.size() < posts_at_once) {
        posts.push_back(std::move(posts_.front()));
        posts_.pop_front();
      }
    }
    store_posts(posts);
  }
}

void PostgresStore::store_posts(std::vector<Post>& group) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Post*> all;
  for (Post& post : group) all.push_back(&post);
  // Keys are locked in their order, so that no two groups wait for each other.
  std::stable_sort(all.begin(), all.end(), [](const Post* a, const Post* b) {
    return std::tie(a->job.owner, a->job.idempotency_key) < std::tie(b->job.owner, b->job.idempotency_key);
  });
  bool away = false;
  const auto try_to = [&](const std::vector<Post*>& some) -> std::exception_ptr {
    try {
      // Repeated, it finds what was stored before.
      with_connection(true, [&](PostgresConnection& connection) { store_group(connection, some); });
      return nullptr;
    } catch (const StoreAway&) {
      away = true;
      return std::current_exception();
    } catch (...) {
      return std::current_exception();
    }
  };
  const auto end = [&](const std::vector<Post*>& some, const std::exception_ptr& error) {
    std::vector<Changed> changes;
    for (const Post* post : some)
      if (!error && post->outcome.what == Inserted::What::created)
        changes.push_back({.id = post->id, .state = api::JobState::queued});
    if (!error) options_.observer(seconds_since(start), some.size());
    publish(changes);
    for (Post* post : some) post->done(post->outcome, error);
  };
  const std::exception_ptr error = try_to(all);
  if (!error || away || all.size() == 1) return end(all, error);
  for (Post* post : all) end({post}, try_to({post}));  // one bad post must not fail its neighbours
}

void PostgresStore::store_group(PostgresConnection& connection, std::vector<Post*> group) {
  // What the posts are decided by, as it was when the group began; posts of the group are counted on top of it.
  const auto key_of = [](const Post& post) { return KeyName(post.job.owner.value_or(""), post.job.idempotency_key); };
  std::map<KeyName, std::pair<std::string, std::string>> known;  // hash, id
  std::vector<std::string> key_owners, keys;
  std::set<std::pair<std::string, std::int64_t>> quotas;
  std::size_t most_queued = std::numeric_limits<std::size_t>::max();
  for (const Post* post : group) {
    if (!post->job.idempotency_key.empty()) {
      key_owners.push_back(post->job.owner.value_or(""));
      keys.push_back(post->job.idempotency_key);
    }
    if (post->job.owner && (post->job.max_owned || post->job.max_planning_ms))
      quotas.emplace(*post->job.owner, post->job.now / ms_per_day);
    most_queued = std::min(most_queued, post->job.max_queued);
  }
  auto queued = queued_count(group.size(), most_queued);
  Statements queries;
  if (!queued) queries.push_back({"SELECT coalesce(sum(jobs), 0)::bigint FROM count_deltas WHERE state = 'queued'"});
  if (!keys.empty())
    queries.push_back(
        {"SELECT owner, key, body_hash, id FROM idempotency_keys WHERE (owner, key) IN (SELECT * FROM unnest($1, $2))",
         PostgresParameters().texts(key_owners).texts(keys)});
  for (const auto& [owner, day] : quotas)
    queries.push_back(
        {"SELECT coalesce(sum(jobs), 0)::bigint, coalesce((SELECT ms FROM planning_use WHERE owner = $1 "
         "AND day = $2), 0) FROM count_deltas WHERE state = 'queued' AND owner = $1",
         PostgresParameters() << owner << day});
  const auto rows = connection.run_all(queries);
  auto next = rows.begin();
  if (!queued) queued = counted(static_cast<std::size_t>(std::max<std::int64_t>(0, (next++)->integer(0, 0))));
  if (!keys.empty()) {
    const PostgresRows& found = *next++;
    for (std::size_t row = 0; row < found.size(); ++row)
      known[{found.text(row, 0), found.text(row, 1)}] = {found.text(row, 2), found.uuid(row, 3)};
  }
  std::map<std::pair<std::string, std::int64_t>, std::pair<std::int64_t, std::int64_t>> used;  // jobs queued, ms spent
  for (const auto& quota : quotas) {
    used[quota] = {next->integer(0, 0), next->integer(0, 1)};
    ++next;
  }

  std::vector<Post*> admitted;
  for (Post* post : group) {
    const NewJob& job = post->job;
    const auto keyed = job.idempotency_key.empty() ? known.end() : known.find(key_of(*post));
    if (keyed != known.end()) {
      const auto& [hash, id] = keyed->second;
      if (id == post->id)
        post->outcome = {Inserted::What::created, id};
      else
        post->outcome =
            hash == job.body_hash ? Inserted{Inserted::What::replayed, id} : Inserted{Inserted::What::conflict, ""};
      continue;
    }
    auto quota = job.owner ? used.find({*job.owner, job.now / ms_per_day}) : used.end();
    if (*queued >= job.max_queued) {
      post->outcome = {Inserted::What::full, ""};
      continue;
    }
    if (quota != used.end() && job.max_owned && quota->second.first >= *job.max_owned) {
      post->outcome = {Inserted::What::owner_full, ""};
      continue;
    }
    if (quota != used.end() && job.max_planning_ms && quota->second.second >= *job.max_planning_ms) {
      post->outcome = {Inserted::What::planning_spent, ""};
      continue;
    }
    ++*queued;
    if (quota != used.end()) ++quota->second.first;
    admitted.push_back(post);
  }

  // One transaction; large documents take their time.
  Statements inserts;
  if (!admitted.empty()) inserts.push_back({planned_once});
  std::size_t bytes = 0;
  for (std::size_t first = 0; first < admitted.size();) {
    const auto size = [&](std::size_t k) { return admitted[k]->packed.size(); };
    std::size_t end = first + 1, held = size(first);
    while (size(first) < large_bytes && end < admitted.size() && size(end) < large_bytes &&
           held + size(end) <= statement_bytes)
      held += size(end++);
    inserts.push_back(statement_of(std::span(admitted).subspan(first, end - first)));
    bytes += held;
    first = end;
  }
  const auto results = bytes <= lengthy_bytes ? connection.run_all(inserts) : connection.run_all_lengthy(inserts);
  std::set<std::string> stored;
  for (std::size_t k = 1; k < results.size(); ++k)
    for (std::size_t row = 0; row < results[k].size(); ++row) stored.insert(results[k].uuid(row, 0));
  counted_more(stored.size());
  std::vector<Post*> again;
  for (Post* post : admitted) {
    if (stored.contains(post->id) || post->job.idempotency_key.empty())
      post->outcome = {Inserted::What::created, post->id};
    else
      again.push_back(post);  // another post with its key came first: it is found now
  }
  if (!again.empty()) store_group(connection, std::move(again));
}

/// Returns the statement that stores these posts; a large document is alone in it.
PostgresStatement PostgresStore::statement_of(std::span<Post* const> posts) const {
  using Texts = std::vector<std::optional<std::string>>;
  std::vector<std::string> ids, unchecked;
  Texts kinds, names, references, owners, tags, callbacks, secrets, receivers, keys, hashes;
  std::vector<std::int64_t> ranks;
  std::vector<std::optional<std::int64_t>> deadlines, times;
  std::vector<std::optional<double>> budgets;
  std::vector<std::optional<std::string_view>> documents;
  std::optional<std::string_view> large;
  for (const Post* const post : posts) {
    const NewJob& job = post->job;
    const api::JobRequest& r = job.request;
    ids.push_back(post->id);
    if (!r.checked) unchecked.push_back(post->id);
    kinds.emplace_back(r.kind);
    names.push_back(r.name);
    references.push_back(r.reference);
    owners.push_back(job.owner);
    tags.emplace_back();
    for (const std::string& tag : r.tags) tags.back() = tags.back() ? *tags.back() + tag_end + tag : tag;
    ranks.push_back(-r.priority);
    deadlines.push_back(r.deadline);
    budgets.push_back(r.time_budget);
    times.emplace_back(job.now);
    callbacks.push_back(r.callback ? std::optional(r.callback->url) : std::nullopt);
    secrets.push_back(r.callback ? r.callback->secret : std::nullopt);
    receivers.push_back(job.callback_receiver);
    const bool keyed = !job.idempotency_key.empty();
    keys.push_back(keyed ? std::optional(job.idempotency_key) : std::nullopt);
    hashes.push_back(keyed ? std::optional(job.body_hash) : std::nullopt);
    if (post->packed.size() >= large_bytes) large = post->packed;
    documents.push_back(large ? std::nullopt : std::optional<std::string_view>(post->packed));
  }
  PostgresParameters values;
  values.uuids(ids).texts(kinds).texts(names).texts(references).texts(owners).texts(tags).integers(ranks);
  values.times(deadlines).numbers(budgets).times(times).texts(callbacks).texts(secrets).texts(receivers).texts(keys);
  values.texts(hashes).bytes(documents).bytes(large.value_or(std::string_view())) << std::int64_t{options_.engine};
  values.uuids(unchecked);
  return {insert_jobs, std::move(values)};
}

/// Returns the number of queued jobs if it was read a moment ago and admits so many posts.
std::optional<std::size_t> PostgresStore::queued_count(std::size_t posts, std::size_t most) {
  const std::lock_guard lock(queued_mutex_);
  if (std::chrono::steady_clock::now() >= queued_known_ + counted_for || queued_ + posts > most) return std::nullopt;
  return queued_;
}

std::size_t PostgresStore::counted(std::size_t queued) {
  const std::lock_guard lock(queued_mutex_);
  queued_known_ = std::chrono::steady_clock::now();
  return queued_ = queued;
}

void PostgresStore::counted_more(std::size_t posts) {
  const std::lock_guard lock(queued_mutex_);
  queued_ += posts;
}

}  // namespace bahnwerk::server
