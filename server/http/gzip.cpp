#include "server/http/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include "api/problem.hpp"

namespace bahnwerk::server {
namespace {

struct Inflater {
  z_stream stream{};
  Inflater() {
    if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) throw std::runtime_error("zlib: no memory");
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

}  // namespace

std::optional<std::string> gunzip(std::string_view packed, std::size_t most) {
  Inflater inflater;
  z_stream& z = inflater.stream;
  std::string text;
  std::array<char, 64 << 10> piece;
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  std::size_t left = packed.size();
  for (bool whole = false;;) {
    if (z.avail_in == 0) {
      if (left == 0 && whole) return text;
      const auto feed = std::min<std::size_t>(left, std::numeric_limits<uInt>::max());
      z.avail_in = static_cast<uInt>(feed);
      left -= feed;
    }
    if (whole && inflateReset(&z) != Z_OK) throw std::runtime_error("zlib: reset");  // another member follows
    z.next_out = reinterpret_cast<Bytef*>(piece.data());
    z.avail_out = static_cast<uInt>(piece.size());
    const int code = inflate(&z, Z_NO_FLUSH);
    if (code == Z_MEM_ERROR) throw std::runtime_error("zlib: no memory");
    if (code != Z_OK && code != Z_STREAM_END)
      throw api::Problem("bad-request", code == Z_BUF_ERROR ? "The gzip body is not complete."
                                                            : "The body is not valid gzip, as Content-Encoding says.");
    whole = code == Z_STREAM_END;
    const std::size_t got = piece.size() - z.avail_out;
    if (got > most - text.size()) return std::nullopt;
    text.append(piece.data(), got);
  }
}

}  // namespace bahnwerk::server
