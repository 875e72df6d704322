/// SqliteStore: the list of jobs. Indexes begin with the owner, so that one owner's list costs the same whatever others
/// have; the list of all owners is merged from theirs.
#include <algorithm>

#include "server/store/sqlite/reader.hpp"
#include "server/store/sqlite/rows.hpp"

namespace bahnwerk::server {
namespace {

/// So many jobs at the begin of the list are looked at for a text, before the indexes of texts are: these have to be
/// sorted, and a text that many jobs have is found by the order sooner.
constexpr std::size_t looked_at_first = 2'000;

/// Whose jobs are listed; nullopt: those without owner.
using Owner = std::optional<std::string>;

/// A query that is put together with the texts that are bound to it.
struct Sql {
  std::string text;
  std::vector<std::string> values;
  Sql& add(std::string_view more, std::vector<std::string> bound = {}) {
    text += more;
    values.insert(values.end(), bound.begin(), bound.end());
    return *this;
  }
  Sql& owned_by(const Owner& owner) { return owner ? add("owner = ?", {*owner}) : add("owner IS NULL"); }
};

/// Returns a text behind all those that begin with `prefix`, which is not empty, and before all others behind them.
std::string behind(std::string prefix) {
  ++prefix.back();  // of UTF-8, no byte is 0xFF
  return prefix;
}

void add_range(Sql& sql, std::string_view column, const std::string& prefix) {
  sql.add(std::string(column) + " >= ? AND " + std::string(column) + " < ?", {prefix, behind(prefix)});
}

constexpr std::string_view text_columns[] = {"name", "reference", "id"};

void add_bounds(Sql& sql, const JobFilter& filter, const std::string& id) {
  // Ids are in the order of time, so that one index serves times and pages.
  if (!filter.before.empty()) sql.add(" AND " + id + (filter.oldest_first ? " > ?" : " < ?"), {filter.before});
  if (filter.created_before) sql.add(" AND " + id + " < ?", {first_id(*filter.created_before)});
  if (filter.created_after) sql.add(" AND " + id + " >= ?", {first_id(*filter.created_after)});
}

/// Few jobs are in another state than succeeded: these are found by it.
bool rare_state(const JobFilter& filter) { return filter.state && *filter.state != api::JobState::succeeded; }
bool found_by_tag(const JobFilter& filter) { return filter.tag && !rare_state(filter) && !filter.text; }

/// Adds the conditions on columns. A column with a plus is not looked up in an index: SQLite does not know which of
/// several is the better one.
void add_conditions(Sql& sql, const JobFilter& filter, bool in_order, const Owner& owner) {
  const bool by_kind = !in_order && !filter.reference && !rare_state(filter);
  const bool by_state = !in_order && !filter.reference && !(filter.kind && by_kind);
  if (filter.state)
    sql.add(by_state ? " AND state = ?" : " AND +state = ?", {std::string(api::to_string(*filter.state))});
  if (filter.kind) sql.add(by_kind ? " AND kind = ?" : " AND +kind = ?", {*filter.kind});
  if (filter.reference) sql.add(in_order ? " AND +reference = ?" : " AND reference = ?", {*filter.reference});
  if (filter.tag && !found_by_tag(filter))
    sql.add(" AND EXISTS (SELECT 1 FROM job_tags WHERE owner = ? AND tag = ? AND job_tags.id = jobs.id)",
            {owner.value_or(""), *filter.tag});
}

std::vector<api::Job> jobs_of(SqliteConnection& connection, const JobFilter& filter, const std::string& id, Sql sql) {
  sql.add(" ORDER BY " + id + (filter.oldest_first ? "" : " DESC") + " LIMIT ?");
  Query rows = connection.query(sql.text);
  for (const std::string& value : sql.values) rows << value;
  rows << static_cast<std::int64_t>(filter.limit);
  std::vector<api::Job> jobs;
  while (rows.step()) jobs.push_back(job_from_row(rows));
  return jobs;
}

Sql select(std::string_view from, std::vector<std::string> bound = {}) {
  return Sql{std::string("SELECT ").append(job_columns).append(" FROM ").append(from), std::move(bound)};
}

/// Lists jobs of one owner that match a filter without text, by the index of its rarest part.
std::vector<api::Job> page(SqliteConnection& connection, const JobFilter& filter, const Owner& owner) {
  Sql sql = select("jobs WHERE ");
  sql.owned_by(owner);
  add_conditions(sql, filter, false, owner);
  add_bounds(sql, filter, "id");
  return jobs_of(connection, filter, "id", std::move(sql));
}

/// Lists jobs of one owner, or of all, with a tag.
std::vector<api::Job> tagged(SqliteConnection& connection, const JobFilter& filter) {
  Sql sql = select(
      "(SELECT id AS listed FROM job_tags WHERE owner = ? AND tag = ?) CROSS JOIN jobs ON id = listed WHERE true",
      {filter.owner.value_or(""), *filter.tag});
  add_conditions(sql, filter, true, filter.owner);
  add_bounds(sql, filter, "listed");
  return jobs_of(connection, filter, "listed", std::move(sql));
}

/// Lists jobs of one owner, or of all, in their order. With `most`, among so many of them alone.
std::vector<api::Job> in_order(SqliteConnection& connection, const JobFilter& filter, std::optional<std::size_t> most) {
  Sql sql = select(most ? "(SELECT * FROM jobs WHERE true" : "jobs WHERE true");
  if (filter.owner) sql.add(" AND ").owned_by(filter.owner);
  add_bounds(sql, filter, "id");
  if (most)
    sql.add(std::string(" ORDER BY id") + (filter.oldest_first ? "" : " DESC") + " LIMIT " + std::to_string(*most) +
            ") AS jobs WHERE true");
  add_conditions(sql, filter, true, filter.owner);
  if (filter.text) {
    for (const std::string_view column : text_columns) {
      sql.add(column == "name" ? " AND (" : " OR ");
      add_range(sql, "+" + std::string(column), *filter.text);
    }
    sql.add(")");
  }
  return jobs_of(connection, filter, "id", std::move(sql));
}

/// Lists jobs of one owner with a text, by the indexes of texts.
std::vector<api::Job> with_text(SqliteConnection& connection, const JobFilter& filter, const Owner& owner) {
  Sql sql = select("(");
  for (const std::string_view column : text_columns) {
    sql.add(column == "name" ? "SELECT * FROM (" : ") UNION SELECT * FROM (");
    sql.add("SELECT id AS listed FROM jobs WHERE ");
    // The index of ids has them in order; one that begins with the owner would be read as a whole.
    (column == "id" && !owner ? sql.add("+owner IS NULL") : sql.owned_by(owner)).add(" AND ");
    add_range(sql, column, *filter.text);
    add_conditions(sql, filter, true, owner);
    add_bounds(sql, filter, column == "id" ? "id" : "+id");
    sql.add(std::string(" ORDER BY id") + (filter.oldest_first ? "" : " DESC") + " LIMIT " +
            std::to_string(filter.limit));
  }
  sql.add(")) CROSS JOIN jobs ON id = listed");
  return jobs_of(connection, filter, "listed", std::move(sql));
}

std::vector<Owner> all_owners(SqliteConnection& connection) {
  std::vector<Owner> owners;
  Query rows = connection.query("SELECT DISTINCT owner FROM job_counts");
  while (rows.step()) owners.push_back(rows.text(0).empty() ? Owner() : Owner(rows.text(0)));
  return owners;
}

}  // namespace

std::vector<api::Job> SqliteStore::list(const JobFilter& filter) {
  Reader reader(*this);
  SqliteConnection& connection = reader.connection();
  if (found_by_tag(filter)) return tagged(connection, filter);
  if (!(filter.state || filter.kind || filter.reference || filter.text)) return in_order(connection, filter, {});
  std::vector<api::Job> jobs;
  if (filter.text) {
    jobs = in_order(connection, filter, looked_at_first);
    if (jobs.size() == filter.limit) return jobs;
    jobs.clear();
  }
  const auto owners = filter.owner ? std::vector<Owner>{filter.owner} : all_owners(connection);
  for (const Owner& owner : owners)
    for (api::Job& job : filter.text ? with_text(connection, filter, owner) : page(connection, filter, owner))
      jobs.push_back(std::move(job));
  const auto first = [&](const api::Job& a, const api::Job& b) {
    return filter.oldest_first ? a.id < b.id : b.id < a.id;
  };
  std::sort(jobs.begin(), jobs.end(), first);
  if (jobs.size() > filter.limit) jobs.resize(filter.limit);
  return jobs;
}

std::vector<Running> SqliteStore::running() {
  Reader reader(*this);
  Query rows = reader.query("SELECT id, revision FROM jobs WHERE state = 'running' ORDER BY id");
  std::vector<Running> running;
  while (rows.step()) running.push_back({rows.text(0), static_cast<std::uint64_t>(rows.integer(1))});
  return running;
}

std::vector<std::string> SqliteStore::queue(std::size_t limit) {
  Reader reader(*this);
  Query rows = reader.query(
      "SELECT id FROM jobs INDEXED BY jobs_queue WHERE state = 'queued' ORDER BY priority DESC, turn, seq LIMIT ?");
  rows << static_cast<std::int64_t>(limit);
  std::vector<std::string> ids;
  while (rows.step()) ids.push_back(rows.text(0));
  return ids;
}

std::map<api::JobState, std::size_t> SqliteStore::counts(const std::optional<std::string>& owner) {
  std::map<api::JobState, std::size_t> counts;
  for (const auto state : {api::JobState::queued, api::JobState::running, api::JobState::succeeded,
                           api::JobState::failed, api::JobState::cancelled})
    counts[state] = 0;
  Reader reader(*this);
  Query rows = reader.query("SELECT state, jobs FROM job_counts WHERE ?1 IS NULL OR owner = ?1");
  rows << owner;
  while (rows.step())
    if (const auto state = api::job_state(rows.text(0))) counts[*state] += static_cast<std::size_t>(rows.integer(1));
  return counts;
}

}  // namespace bahnwerk::server
