#include "server/http/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
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

struct Gzip::State {
  z_stream stream{};
};

Gzip::Gzip() : state_(std::make_unique<State>()) {
  constexpr int level = 4;  // about 60 MB of setpoints a second; the best level saves another tenth in five times that
  if (deflateInit2(&state_->stream, level, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
}

Gzip::~Gzip() { deflateEnd(&state_->stream); }

void Gzip::deflate(std::string_view text, int flush, std::string& out) {
  z_stream& z = state_->stream;
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  z.avail_in = static_cast<uInt>(text.size());
  std::array<char, 32 << 10> piece;
  do {
    z.next_out = reinterpret_cast<Bytef*>(piece.data());
    z.avail_out = static_cast<uInt>(piece.size());
    ::deflate(&z, flush);
    out.append(piece.data(), piece.size() - z.avail_out);
  } while (z.avail_out == 0);
}

void Gzip::add(std::string_view text, std::string& out) {
  constexpr std::size_t most = std::size_t{1} << 30;  // zlib counts with 32 bits
  for (; text.size() > most; text.remove_prefix(most)) deflate(text.substr(0, most), Z_NO_FLUSH, out);
  deflate(text, Z_NO_FLUSH, out);
}

void Gzip::finish(std::string& out) { deflate({}, Z_FINISH, out); }

}  // namespace bahnwerk::server
