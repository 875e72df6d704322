/// SqliteStore: documents and results, which are read in pieces.
#include "server/store/codec.hpp"
#include "server/store/packed_text.hpp"
#include "server/store/sqlite/reader.hpp"
#include "server/store/sqlite/rows.hpp"
#include "server/store/unpacking.hpp"

namespace bahnwerk::server {

PackedPart SqliteStore::part_of(BlobColumn column, std::int64_t seq) {
  return [this, column, seq](std::size_t offset, std::size_t bytes) {
    Reader reader(*this);
    return reader.connection().blob_part(column, seq, offset, bytes);
  };
}

std::unique_ptr<StoredText> SqliteStore::open_document(const std::string& id) {
  std::int64_t seq = 0, form = 0;
  std::size_t bytes = 0;
  std::string kind;
  {
    Reader reader(*this);
    Query row = reader.query("SELECT seq, length(spec), whole, kind FROM jobs JOIN specs USING (seq) WHERE id = ?");
    row << id;
    if (!row.step()) return nullptr;
    seq = row.integer(0);
    bytes = static_cast<std::size_t>(row.integer(1));
    form = row.integer(2);
    kind = row.text(3);
  }
  PackedPart part = part_of({"specs", "spec"}, seq);
  if (form != spec_alone) return open_packed_text(bytes, std::move(part));
  return unpacking([&] { return whole_text(unpack_document(kind, part(0, bytes), false)); });
}

std::unique_ptr<StoredText> SqliteStore::open_result(const std::string& id) {
  std::int64_t seq = 0;
  std::size_t bytes = 0;
  {
    Reader reader(*this);
    Query row = reader.query("SELECT seq, length(document) FROM results JOIN jobs USING (seq) WHERE id = ?");
    row << id;
    if (!row.step()) return nullptr;
    seq = row.integer(0);
    bytes = static_cast<std::size_t>(row.integer(1));
  }
  return open_packed_text(bytes, part_of({"results", "document"}, seq));
}

}  // namespace bahnwerk::server
