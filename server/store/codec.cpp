#include "server/store/codec.hpp"

#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

namespace bahnwerk::server {
namespace {

constexpr int text_level = 3;
constexpr int row_level = 1;  // of long series 2 % larger than level 3, and a tenth of the time that a plan takes less
constexpr std::uint32_t max_rows = 1U << 20;

constexpr std::uint32_t index_magic = 0x184D2A50;
constexpr std::size_t index_fixed = 16;  // magic, bytes that follow, size of the text

[[noreturn]] void damaged() { throw std::runtime_error("stored data is damaged"); }

void throw_if_short_of_memory(std::size_t code) {
  if (ZSTD_getErrorCode(code) == ZSTD_error_memory_allocation) throw std::bad_alloc();
}

/// A thread keeps what zstd needs for unpacking, 160 kB: to allocate it takes longer than to unpack a part of a view.
void decompress(std::string_view packed, void* out, std::size_t size) {
  thread_local std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(nullptr, ZSTD_freeDCtx);
  if (!context) context.reset(ZSTD_createDCtx());
  if (!context) throw std::bad_alloc();
  const std::size_t read = ZSTD_decompressDCtx(context.get(), out, size, packed.data(), packed.size());
  throw_if_short_of_memory(read);
  if (ZSTD_isError(read) || read != size) damaged();
}

template <class Number>
Number number_at(std::string_view bytes, std::size_t at) {
  Number value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::size_t content_size(std::string_view packed) {
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size > (1ULL << 40)) damaged();
  return size;
}

std::uint64_t zigzag(std::uint64_t v) { return (v << 1) ^ (0 - (v >> 63)); }
std::uint64_t unzigzag(std::uint64_t v) { return (v >> 1) ^ (0 - (v & 1)); }

}  // namespace

/// Compresses pieces, each to a frame of its own.
class Compressor::Frames {
 public:
  Frames() : context_(ZSTD_createCCtx(), ZSTD_freeCCtx) {
    if (!context_) throw std::bad_alloc();
  }
  /// Appends a frame to `out`. What `out` takes is the frames, not the room that they needed while they were made.
  void append(const void* data, std::size_t size, int level, std::string& out) {
    if (const std::size_t room = ZSTD_compressBound(size); room > room_) {
      frame_.reset();
      frame_.reset(new char[room]);
      room_ = room;
    }
    const std::size_t written = ZSTD_compressCCtx(context_.get(), frame_.get(), room_, data, size, level);
    throw_if_short_of_memory(written);
    if (ZSTD_isError(written)) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(written));
    out.append(frame_.get(), written);
  }

 private:
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context_;
  std::size_t room_ = 0;
  std::unique_ptr<char[]> frame_;
};

Compressor::Compressor() : frames_(std::make_unique<Frames>()) {}
Compressor::~Compressor() = default;

std::string pack_text(std::string_view text) { return Compressor().text(text); }

std::string Compressor::text(std::string_view text) {
  std::string out;
  if (text.size() <= text_piece) {
    frames_->append(text.data(), text.size(), text_level, out);
    return out;
  }
  const std::size_t frames = (text.size() + text_piece - 1) / text_piece;
  out.resize(index_fixed + frames * sizeof(std::uint32_t));
  const auto put = [&out](std::size_t at, auto number) { std::memcpy(out.data() + at, &number, sizeof number); };
  put(0, index_magic);
  put(4, static_cast<std::uint32_t>(out.size() - 8));
  put(8, std::uint64_t{text.size()});
  for (std::size_t k = 0; k < frames; ++k) {
    const std::string_view piece = text.substr(k * text_piece, text_piece);
    const std::size_t begin = out.size();
    frames_->append(piece.data(), piece.size(), text_level, out);
    put(index_fixed + k * sizeof(std::uint32_t), static_cast<std::uint32_t>(out.size() - begin));
  }
  return out;
}

std::size_t text_index_size(std::string_view head) {
  if (head.size() < text_index_head || number_at<std::uint32_t>(head, 0) != index_magic) return 0;
  return 8 + std::size_t{number_at<std::uint32_t>(head, 4)};
}

TextIndex text_index(std::string_view packed) {
  const std::size_t size = text_index_size(packed);
  if (size < index_fixed || size > packed.size()) damaged();
  TextIndex index;
  index.size = number_at<std::uint64_t>(packed, 8);
  const std::size_t frames = (size - index_fixed) / sizeof(std::uint32_t);
  if (index.size > frames * text_piece || index.size + text_piece <= frames * text_piece) damaged();
  for (std::size_t k = 0, at = size; k < frames; ++k) {
    const std::size_t bytes = number_at<std::uint32_t>(packed, index_fixed + k * sizeof(std::uint32_t));
    index.frames.emplace_back(at, bytes);
    at += bytes;
  }
  return index;
}

std::string unpack_text(std::string_view packed) {
  const std::size_t index = text_index_size(packed);
  std::string out(index > 0 ? text_index(packed).size : content_size(packed), '\0');
  decompress(packed, out.data(), out.size());
  return out;
}

std::string Compressor::rows(const double* values, std::size_t rows, std::size_t columns) {
  if (rows > max_rows) throw std::invalid_argument("too many rows for one chunk");
  // Plane (column, byte): the byte of weight 2^(8 byte) of every row's zigzagged second difference.
  std::vector<unsigned char> planes(4 + rows * columns * 8);
  const auto header = static_cast<std::uint32_t>(rows);
  std::memcpy(planes.data(), &header, 4);
  for (std::size_t c = 0; c < columns; ++c) {
    unsigned char* plane = planes.data() + 4 + c * rows * 8;
    std::uint64_t before = 0, step = 0;
    for (std::size_t r = 0; r < rows; ++r) {
      const auto bits = std::bit_cast<std::uint64_t>(values[r * columns + c]);
      const std::uint64_t now = bits - before;
      const std::uint64_t code = zigzag(now - step);
      before = bits;
      step = now;
      for (std::size_t b = 0; b < 8; ++b) plane[b * rows + r] = static_cast<unsigned char>(code >> (8 * b));
    }
  }
  std::string out;
  frames_->append(planes.data(), planes.size(), row_level, out);
  return out;
}

void unpack_rows(std::string_view packed, std::size_t columns, std::vector<double>& out) {
  const std::size_t size = content_size(packed);
  if (size < 4 || size > 4 + std::size_t{max_rows} * columns * 8)
    throw std::runtime_error("stored setpoints are damaged");
  std::vector<unsigned char> planes(size);
  decompress(packed, planes.data(), size);
  std::uint32_t rows = 0;
  std::memcpy(&rows, planes.data(), 4);
  if (size != 4 + std::size_t{rows} * columns * 8) throw std::runtime_error("stored setpoints are damaged");
  out.resize(rows * columns);
  for (std::size_t c = 0; c < columns; ++c) {
    const unsigned char* plane = planes.data() + 4 + c * rows * 8;
    std::uint64_t before = 0, step = 0;
    for (std::size_t r = 0; r < rows; ++r) {
      std::uint64_t code = 0;
      for (std::size_t b = 0; b < 8; ++b) code |= std::uint64_t{plane[b * rows + r]} << (8 * b);
      step += unzigzag(code);
      before += step;
      out[r * columns + c] = std::bit_cast<double>(before);
    }
  }
}

}  // namespace bahnwerk::server
