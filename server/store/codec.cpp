#include "server/store/codec.hpp"

#include <zstd.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace bahnwerk::server {
namespace {

constexpr int level = 3;
constexpr std::uint32_t max_rows = 1U << 20;

std::string compress(const void* data, std::size_t size) {
  std::string out(ZSTD_compressBound(size), '\0');
  const std::size_t written = ZSTD_compress(out.data(), out.size(), data, size, level);
  if (ZSTD_isError(written)) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(written));
  out.resize(written);
  return out;
}

void decompress(std::string_view packed, void* out, std::size_t size) {
  const std::size_t read = ZSTD_decompress(out, size, packed.data(), packed.size());
  if (ZSTD_isError(read) || read != size) throw std::runtime_error("stored data is damaged");
}

std::size_t content_size(std::string_view packed) {
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size > (1ULL << 40))
    throw std::runtime_error("stored data is damaged");
  return size;
}

std::uint64_t zigzag(std::uint64_t v) { return (v << 1) ^ (0 - (v >> 63)); }
std::uint64_t unzigzag(std::uint64_t v) { return (v >> 1) ^ (0 - (v & 1)); }

}  // namespace

std::string pack_text(std::string_view text) { return compress(text.data(), text.size()); }

std::string unpack_text(std::string_view packed) {
  std::string out(content_size(packed), '\0');
  decompress(packed, out.data(), out.size());
  return out;
}

std::string pack_rows(const double* values, std::size_t rows, std::size_t columns) {
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
  return compress(planes.data(), planes.size());
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
