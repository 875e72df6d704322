#include "server/routes/submit.hpp"

#include <openssl/evp.h>

#include <algorithm>

#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/gzip.hpp"
#include "server/runtime/clock.hpp"
#include "server/runtime/memory.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t large_document = 1 << 20;  ///< bytes; a parsed document takes about 25 times its text

/// Returns the memory of checking a large document to the system, valid or not.
struct GiveBack {
  explicit GiveBack(std::size_t bytes) : large(bytes >= worth_giving_back) {}
  ~GiveBack() {
    if (large) give_back_memory();
  }
  GiveBack(const GiveBack&) = delete;
  GiveBack& operator=(const GiveBack&) = delete;
  const bool large;
};

std::string sha256(std::string_view text) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  if (EVP_Digest(text.data(), text.size(), digest, &size, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 failed");
  std::string out;
  for (unsigned int i = 0; i < size; ++i) {
    out += "0123456789abcdef"[digest[i] >> 4];
    out += "0123456789abcdef"[digest[i] & 15];
  }
  return out;
}

std::string idempotency_key(const Request& request) {
  const auto named = [](const auto& header) { return header.first == "idempotency-key"; };
  const auto key = std::find_if(request.headers.begin(), request.headers.end(), named);
  if (key == request.headers.end()) return "";
  if (std::any_of(key + 1, request.headers.end(), named))
    throw api::Problem("bad-request", "Idempotency-Key is given more than once.");
  const std::string& text = key->second;
  const bool visible = std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < 127; });
  if (text.empty() || text.size() > 255 || !visible)
    throw api::Problem("bad-request", "Idempotency-Key takes 1 to 255 printable ASCII characters.");
  return text;
}

Response accepted(Context& context, const Inserted& inserted) {
  switch (inserted.what) {
    case Inserted::What::conflict:
      throw api::Problem("idempotency-conflict", "This Idempotency-Key was used before with another body.");
    case Inserted::What::full:
      throw api::Problem("too-many-jobs",
                         std::to_string(context.max_queued) + " jobs are waiting; no more are taken now.");
    case Inserted::What::created:
    case Inserted::What::replayed:
      break;
  }
  const api::Job job = find_job(context, inserted.id);
  Response response = job_answer(202, job);
  response.set("Location", "/v1/jobs/" + job.id);
  return response;
}

/// Returns the uncompressed body, with the size limit of a plain one.
void unpack_body(Request& request, std::size_t most) {
  auto text = gunzip(request.body, most);
  if (!text) throw http_problem(413, "The request body, unpacked, is larger than " + std::to_string(most) + " bytes.");
  request.body = std::move(*text);
}

}  // namespace

void submit(Context& context, const RequestPtr& request, const Reply& reply) {
  require_json(*request);
  if (!is_json(request->header("content-type").value_or("")))
    throw api::Problem("unsupported-media-type", "Job documents are posted with Content-Type: application/json.");
  const auto coding = content_coding(request->header("content-encoding").value_or(""));
  if (!coding) {
    Response response =
        problem_answer(api::Problem("unsupported-media-type", "Of content codings only gzip and identity are known."),
                       request->target);
    response.set("Accept-Encoding", "gzip, identity");
    return reply(std::move(response));
  }
  if (context.draining) throw api::Problem("draining", "The server is about to stop and takes no new jobs.");
  NewJob job;
  job.idempotency_key = idempotency_key(*request);
  // The size of a packed body is known only when it is unpacked: such bodies are handled one after the other, too.
  const bool large = request->body.size() > large_document || *coding == Coding::gzip;
  Pool& pool = large ? context.heavy : context.checks;
  pool.post([&context, request, reply, coding, job = std::move(job)]() mutable {
    try {
      if (*coding == Coding::gzip) unpack_body(*request, context.max_body);
      if (!job.idempotency_key.empty()) job.body_hash = sha256(request->body);
      const GiveBack afterwards(request->body.size());
      job.request = context.parse(request->body);
      job.now = context.time.now_ms();
      job.max_queued = context.max_queued;
      context.store.insert(std::move(job),
                           [&context, request, reply](const Inserted& inserted, std::exception_ptr error) {
                             // This runs on the store's thread: it hands over at once.
                             context.pool.post([&context, request, reply, inserted, error = std::move(error)] {
                               reply_with(*request, reply, [&] {
                                 if (error) std::rethrow_exception(error);
                                 return accepted(context, inserted);
                               });
                             });
                           });
    } catch (...) {
      reply(answer_from_current_exception(*request));
    }
  });
}

}  // namespace bahnwerk::server
