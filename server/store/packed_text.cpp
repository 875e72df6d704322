#include "server/store/packed_text.hpp"

#include <algorithm>

#include "server/store/codec.hpp"
#include "server/store/unpacking.hpp"

namespace bahnwerk::server {
namespace {

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

class FramedText final : public StoredText {
 public:
  FramedText(PackedPart part, TextIndex index) : part_(std::move(part)), index_(std::move(index)) {}
  std::size_t size() const override { return index_.size; }
  bool next(std::string& out) override {
    if (at_ == index_.frames.size()) return false;
    const auto [offset, bytes] = index_.frames[at_++];
    const std::string frame = part_(offset, bytes);
    unpacking([&] { out += unpack_text(frame); });
    return true;
  }

 private:
  const PackedPart part_;
  const TextIndex index_;
  std::size_t at_ = 0;
};

}  // namespace

std::unique_ptr<StoredText> whole_text(std::string text) { return std::make_unique<WholeText>(std::move(text)); }

std::unique_ptr<StoredText> open_packed_text(std::size_t bytes, PackedPart part) {
  return unpacking([&]() -> std::unique_ptr<StoredText> {
    if (const std::size_t index = text_index_size(part(0, std::min(text_index_head, bytes))); index > 0) {
      TextIndex places = text_index(part(0, std::min(index, bytes)));
      return std::make_unique<FramedText>(std::move(part), std::move(places));
    }
    return whole_text(unpack_text(part(0, bytes)));
  });
}

}  // namespace bahnwerk::server
