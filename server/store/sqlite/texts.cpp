/// SqliteStore: documents and results, which are read in pieces.
#include "server/store/codec.hpp"
#include "server/store/sqlite/reader.hpp"
#include "server/store/sqlite/rows.hpp"
#include "server/store/sqlite/unpacking.hpp"

namespace bahnwerk::server {
namespace {

/// A text that is in memory.
class WholeText final : public StoredText {
 public:
  explicit WholeText(std::string text) : text_(std::move(text)), size_(text_.size()) {}
  std::size_t size() const override { return size_; }
  bool next(std::string& out) override {
    if (text_.empty()) return false;
    out += text_;
    text_ = {};
    return true;
  }

 private:
  std::string text_;
  const std::size_t size_;
};

}  // namespace

/// A text of many frames. Between two pieces it keeps their index alone: 4 bytes of the row per frame.
class SqliteStore::Text final : public StoredText {
 public:
  Text(SqliteStore& store, BlobColumn column, std::int64_t seq, TextIndex index)
      : store_(store), column_(column), seq_(seq), index_(std::move(index)) {}
  std::size_t size() const override { return index_.size; }
  bool next(std::string& out) override {
    if (at_ == index_.frames.size()) return false;
    const auto [offset, bytes] = index_.frames[at_++];
    Reader reader(store_);
    const std::string frame = reader.connection().blob_part(column_, seq_, offset, bytes);
    unpacking([&] { out += unpack_text(frame); });
    return true;
  }

  /// Opens the text of row `seq` that takes `bytes` packed bytes.
  static std::unique_ptr<StoredText> open(SqliteStore& store, SqliteConnection& connection, BlobColumn column,
                                          std::int64_t seq, std::size_t bytes) {
    const auto part = [&](std::size_t size) { return connection.blob_part(column, seq, 0, std::min(size, bytes)); };
    return unpacking([&]() -> std::unique_ptr<StoredText> {
      if (const std::size_t index = text_index_size(part(text_index_head)); index > 0)
        return std::make_unique<Text>(store, column, seq, text_index(part(index)));
      return std::make_unique<WholeText>(unpack_text(part(bytes)));
    });
  }

 private:
  SqliteStore& store_;
  const BlobColumn column_;
  const std::int64_t seq_;
  const TextIndex index_;
  std::size_t at_ = 0;
};

std::unique_ptr<StoredText> SqliteStore::open_document(const std::string& id) {
  Reader reader(*this);
  Query row = reader.query("SELECT seq, length(spec), whole, kind FROM jobs JOIN specs USING (seq) WHERE id = ?");
  row << id;
  if (!row.step()) return nullptr;
  const std::int64_t seq = row.integer(0);
  const auto bytes = static_cast<std::size_t>(row.integer(1));
  const BlobColumn column{"specs", "spec"};
  if (row.integer(2) != spec_alone) return Text::open(*this, reader.connection(), column, seq, bytes);
  const std::string packed = reader.connection().blob_part(column, seq, 0, bytes);
  return unpacking([&] { return std::make_unique<WholeText>(unpack_document(row.text(3), packed, false)); });
}

std::unique_ptr<StoredText> SqliteStore::open_result(const std::string& id) {
  Reader reader(*this);
  Query row = reader.query("SELECT seq, length(document) FROM results JOIN jobs USING (seq) WHERE id = ?");
  row << id;
  if (!row.step()) return nullptr;
  return Text::open(*this, reader.connection(), {"results", "document"}, row.integer(0),
                    static_cast<std::size_t>(row.integer(1)));
}

}  // namespace bahnwerk::server
