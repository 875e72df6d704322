#pragma once
/// Compression of texts and setpoints, lossless to the last bit, NaN and −0 included.
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bahnwerk::server {

/// Packs texts and rows one after the other. What zstd needs for that, some 100 kB to 1.5 MB, is allocated once: for a
/// piece of a few kB that takes longer than packing it.
class Compressor {
 public:
  Compressor();
  ~Compressor();
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;
  /// Packs a text as pack_text() does.
  std::string text(std::string_view text);
  /// Packs rows × columns doubles, row-major. Setpoints are smooth, so the second difference of the bit patterns per
  /// column is small: differences, zigzag, bytes of equal weight together, then zstd. Packing costs about 50 ns,
  /// unpacking 20 ns per double.
  std::string rows(const double* values, std::size_t rows, std::size_t columns);

 private:
  class Frames;
  std::unique_ptr<Frames> frames_;
};

/// Packs a text. A text of more than text_piece bytes becomes several zstd frames, each of text_piece bytes but the
/// last one, that can be unpacked alone; before them stands an index, which is a skippable frame [RFC 8878, 3.1.2]: the
/// bytes of the text (u64) and of each frame (u32), little-endian.
std::string pack_text(std::string_view text);
/// Unpacks a text, also the single frame that older versions wrote. Throws std::runtime_error when damaged.
std::string unpack_text(std::string_view packed);

inline constexpr std::size_t text_piece = 128 << 10;

/// Places of the frames of a packed text.
struct TextIndex {
  std::size_t size = 0;                                     ///< bytes of the text
  std::vector<std::pair<std::size_t, std::size_t>> frames;  ///< offset and bytes of each frame, in order
};
/// Returns the number of bytes that the index at the begin of a packed text takes; 0 if there is none: the text is one
/// frame. `head` has the first text_index_head bytes, or all.
inline constexpr std::size_t text_index_head = 8;
std::size_t text_index_size(std::string_view head);
/// Returns the index in the first text_index_size() bytes of a packed text. Throws std::runtime_error when damaged.
TextIndex text_index(std::string_view packed);

/// Unpacks rows. Throws std::runtime_error when damaged or not of `columns` columns.
void unpack_rows(std::string_view packed, std::size_t columns, std::vector<double>& out);

}  // namespace bahnwerk::server
