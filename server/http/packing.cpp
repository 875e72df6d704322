#include "server/http/packing.hpp"

#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/gzip.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t worth_packing = 1024;     ///< bytes
constexpr std::string_view ending = "-gzip\"";  ///< of the tag of a packed answer
constexpr std::string_view plain_ending = "\"";

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string packed_tag(const std::string& etag) { return etag.substr(0, etag.size() - 1) + std::string(ending); }

bool may_be_packed(const Response& response) {
  const auto type = response.header("Content-Type");
  return type && !response.feed && !response.header("Content-Encoding") && !type->starts_with("text/event-stream") &&
         response.status != 204 && response.status != 304 &&
         (response.stream ? response.length.value_or(worth_packing) : response.body.size()) >= worth_packing;
}

Response pack(Response response) {
  const auto gzip = std::make_shared<Gzip>();
  response.set("Content-Encoding", "gzip");
  if (const auto etag = response.header("ETag")) response.set("ETag", packed_tag(*etag));
  if (response.stream) {
    response.length.reset();
    response.stream = [gzip, source = std::move(response.stream)](std::string& out) {
      std::string piece;
      const bool more = source(piece);
      gzip->add(piece, out);
      if (!more) gzip->finish(out);
      return more;
    };
    return response;
  }
  std::string packed;
  gzip->add(response.body, packed);
  gzip->finish(packed);
  response.body = std::move(packed);
  return response;
}

}  // namespace

Middleware pack_answers(std::function<void(std::function<void()>)> offload) {
  return [offload = std::move(offload)](Handler next) -> Handler {
    return [offload, next = std::move(next)](RequestPtr request, Reply reply) {
      std::string known;  // tags of packed answers that the client has
      for (auto& [name, value] : request->headers) {
        if (name != "if-none-match" && name != "if-match") continue;
        known += value;
        value = replaced(value, ending, plain_ending);
      }
      const bool wanted = accepts_gzip(request->header("accept-encoding").value_or(""));
      next(request, [offload, request, wanted, known, reply = std::move(reply)](Response response) {
        if (const auto etag = response.header("ETag"); etag && response.status == 304) {
          const std::string packed = packed_tag(*etag);
          if (known.find(packed) != std::string::npos) response.set("ETag", packed);
        }
        if (!may_be_packed(response)) return reply(std::move(response));
        const auto vary = response.header("Vary");
        response.set("Vary", vary ? *vary + ", Accept-Encoding" : "Accept-Encoding");
        if (!wanted) return reply(std::move(response));
        offload([request, reply, response = std::make_shared<Response>(std::move(response))] {
          reply_with(*request, reply, [&] { return pack(std::move(*response)); });
        });
      });
    };
  };
}

}  // namespace bahnwerk::server
