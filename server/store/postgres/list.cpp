/// PostgresStore: the list of jobs. Ids are in the order of time, so that one index serves times and pages.
#include <algorithm>

#include "server/runtime/uuid7.hpp"
#include "server/store/postgres/job_rows.hpp"
#include "server/store/postgres/postgres_store.hpp"

namespace bahnwerk::server {
namespace {

/// So many jobs at the begin of the list are looked at for a text, before the indexes of texts are: a text that many
/// jobs have is found by the order sooner.
constexpr std::int64_t looked_at_first = 2'000;

/// A query that is put together with its parameters.
class Sql {
 public:
  explicit Sql(std::string text) : text_(std::move(text)) {}
  Sql& operator<<(std::string_view more) {
    text_ += more;
    return *this;
  }
  template <class Value>
  std::string value(const Value& value) {
    values_ << value;
    return next();
  }
  std::string uuid(const std::string& id) {
    values_.uuid(id);
    return next();
  }
  PostgresRows run(PostgresConnection& connection) const { return connection.run_lengthy(text_, values_); }

 private:
  std::string next() { return "$" + std::to_string(++count_); }
  std::string text_;
  PostgresParameters values_;
  int count_ = 0;
};

/// The texts that begin with a prefix: from `first` on, and before `behind`, if there is one.
struct TextRange {
  std::string first;
  std::optional<std::string> behind;
};

/// Returns the code point at the end of a text of whole characters, and takes it off.
char32_t take_last(std::string& text) {
  std::size_t at = text.size() - 1;
  while (at > 0 && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) --at;
  const auto lead = static_cast<unsigned char>(text[at]);
  char32_t point = lead < 0x80 ? lead : lead < 0xE0 ? lead & 0x1F : lead < 0xF0 ? lead & 0x0F : lead & 0x07;
  for (std::size_t k = at + 1; k < text.size(); ++k)
    point = (point << 6) | (static_cast<unsigned char>(text[k]) & 0x3F);
  text.resize(at);
  return point;
}

void append(std::string& text, char32_t point) {
  if (point < 0x80) {
    text += static_cast<char>(point);
  } else if (point < 0x800) {
    text += {static_cast<char>(0xC0 | (point >> 6)), static_cast<char>(0x80 | (point & 0x3F))};
  } else if (point < 0x10000) {
    text += {static_cast<char>(0xE0 | (point >> 12)), static_cast<char>(0x80 | ((point >> 6) & 0x3F)),
             static_cast<char>(0x80 | (point & 0x3F))};
  } else {
    text += {static_cast<char>(0xF0 | (point >> 18)), static_cast<char>(0x80 | ((point >> 12) & 0x3F)),
             static_cast<char>(0x80 | ((point >> 6) & 0x3F)), static_cast<char>(0x80 | (point & 0x3F))};
  }
}

/// Returns a text behind all that begin with `text` [order of UTF-8: RFC 3629, 1]; none where it has the last
/// characters alone.
std::optional<std::string> behind_all(std::string text) {
  while (!text.empty()) {
    const char32_t point = take_last(text);
    if (point == 0x10FFFF) continue;
    append(text, point == 0xD7FF ? 0xE000 : point + 1);
    return text;
  }
  return std::nullopt;
}

/// A prefix may end within a character, whose first bytes are then what is looked for.
TextRange range_of(const std::string& prefix) {
  std::size_t lead = prefix.size();
  while (lead > 0 && prefix.size() - lead < 4) {
    const auto byte = static_cast<unsigned char>(prefix[--lead]);
    if ((byte & 0xC0) == 0x80) continue;
    const std::size_t length = byte < 0xC0 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
    if (prefix.size() - lead >= length) break;  // whole
    std::string first = prefix, last = prefix;
    for (std::size_t k = prefix.size() - lead; k < length; ++k) {
      const bool second = k == 1;
      first += static_cast<char>(second && byte == 0xE0 ? 0xA0 : second && byte == 0xF0 ? 0x90 : 0x80);
      last += static_cast<char>(second && byte == 0xED ? 0x9F : second && byte == 0xF4 ? 0x8F : 0xBF);
    }
    return {first, behind_all(last)};
  }
  return {prefix, behind_all(prefix)};
}

/// Returns the first and the last id whose text begins with `prefix`; nullopt: no id does.
std::optional<std::pair<std::string, std::string>> ids_of(const std::string& prefix) {
  constexpr std::string_view lowest = "00000000-0000-0000-0000-000000000000",
                             highest = "ffffffff-ffff-ffff-ffff-ffffffffffff";
  if (prefix.size() > lowest.size()) return std::nullopt;
  for (std::size_t k = 0; k < prefix.size(); ++k) {
    const char c = prefix[k];
    const bool digit = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
    if (lowest[k] == '-' ? c != '-' : !digit) return std::nullopt;
  }
  return std::pair(prefix + std::string(lowest.substr(prefix.size())),
                   prefix + std::string(highest.substr(prefix.size())));
}

void add_bounds(Sql& sql, const JobFilter& filter) {
  if (!filter.before.empty()) sql << (filter.oldest_first ? " AND j.id > " : " AND j.id < ") << sql.uuid(filter.before);
  if (filter.created_before) sql << " AND j.id < " << sql.uuid(first_id(*filter.created_before));
  if (filter.created_after) sql << " AND j.id >= " << sql.uuid(first_id(*filter.created_after));
}

void add_conditions(Sql& sql, const JobFilter& filter) {
  if (filter.owner) sql << " AND j.owner = " << sql.value(*filter.owner);
  if (filter.state) sql << " AND j.state = " << sql.value(std::string(api::to_string(*filter.state)));
  if (filter.kind) sql << " AND j.kind = " << sql.value(*filter.kind);
  if (filter.reference) sql << " AND j.reference = " << sql.value(*filter.reference);
  if (!filter.text) return;
  const TextRange range = range_of(*filter.text);
  const std::string first = sql.value(range.first);
  const std::string behind = range.behind ? sql.value(*range.behind) : "";
  sql << " AND (";
  for (const std::string_view column : {"j.name", "j.reference"}) {
    sql << (column == "j.name" ? "(" : " OR (") << column << " >= " << first;
    if (range.behind) sql << " AND " << column << " < " << behind;
    sql << ")";
  }
  if (const auto ids = ids_of(*filter.text))
    sql << " OR (j.id >= " << sql.uuid(ids->first) << " AND j.id <= " << sql.uuid(ids->second) << ")";
  sql << ")";
}

std::string order(const JobFilter& filter) { return filter.oldest_first ? " ORDER BY j.id" : " ORDER BY j.id DESC"; }

std::vector<api::Job> found(PostgresConnection& connection, const JobFilter& filter, bool begin_alone) {
  Sql sql(std::string("SELECT ").append(postgres_job_columns).append(" FROM "));
  if (begin_alone) {
    sql << "(SELECT * FROM jobs AS j WHERE true";
    add_bounds(sql, filter);
    sql << order(filter) << " LIMIT " << std::to_string(looked_at_first) << ") AS j";
  } else {
    sql << "jobs AS j";
  }
  sql << " LEFT JOIN runs AS r ON r.id = j.id";
  if (filter.tag)
    sql << " JOIN job_tags AS t ON t.id = j.id AND t.owner = " << sql.value(filter.owner.value_or(""))
        << " AND t.tag = " << sql.value(*filter.tag);
  sql << " WHERE true";
  add_bounds(sql, filter);
  add_conditions(sql, filter);
  sql << order(filter) << " LIMIT " << sql.value(static_cast<std::int64_t>(filter.limit));
  const auto rows = sql.run(connection);
  std::vector<api::Job> jobs;
  for (std::size_t row = 0; row < rows.size(); ++row) jobs.push_back(job_from(rows, row));
  return jobs;
}

}  // namespace

std::vector<api::Job> PostgresStore::list(const JobFilter& filter) {
  return reading([&](PostgresConnection& connection) {
    if (filter.text) {
      auto jobs = found(connection, filter, true);
      if (jobs.size() == filter.limit) return jobs;
    }
    return found(connection, filter, false);
  });
}

}  // namespace bahnwerk::server
