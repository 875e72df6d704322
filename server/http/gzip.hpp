#pragma once
/// Decompression of request bodies and compression of answers.
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace bahnwerk::server {

/// Returns the text of a gzip body (RFC 1952, consecutive members included); nullopt if it has more than `most` bytes:
/// a few kilobytes may expand to gigabytes, so unpacking stops there. Memory: the text and 64 KiB. Throws Problem
/// bad-request for a damaged body, or data behind it.
std::optional<std::string> gunzip(std::string_view packed, std::size_t most);

/// Compresses a text piece by piece. The same pieces give the same bytes.
class Gzip {
 public:
  Gzip();
  ~Gzip();
  Gzip(const Gzip&) = delete;
  Gzip& operator=(const Gzip&) = delete;
  void add(std::string_view text, std::string& out);  ///< appends what is complete, often nothing
  void finish(std::string& out);                      ///< appends the rest

 private:
  struct State;
  void deflate(std::string_view text, int flush, std::string& out);
  std::unique_ptr<State> state_;
};

}  // namespace bahnwerk::server
