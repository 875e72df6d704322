#include "server/routes/document_check.hpp"

#include <time.h>

#include <functional>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/gzip.hpp"
#include "server/runtime/clock.hpp"
#include "server/runtime/memory.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t large_document = 1 << 20;  ///< bytes; a parsed document takes about 25 times its text

/// A check takes at most that long, counted from the end of the request, waiting included. The reading of the text and
/// of the envelope is not stopped.
constexpr std::chrono::seconds check_time{2};
/// Processor time of a check beside other ones; a longer check begins again on the thread of large documents.
constexpr std::chrono::milliseconds quick_check{30};

std::chrono::nanoseconds thread_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

/// Stops a check when `over` says so.
class CheckProgress final : public ProgressSink {
 public:
  explicit CheckProgress(std::function<bool()> over) : over_(std::move(over)) {}
  void report(std::string_view, double, std::string_view) override {
    if (over_()) throw Stopped(StopReason::budget);
    if (uses_memory() && memory_is_short()) throw std::bad_alloc();
  }

 private:
  const std::function<bool()> over_;
};

}  // namespace

std::optional<bool> packed_document(const Request& request, const Reply& reply) {
  require_json(request);
  if (!is_json(request.header("content-type").value_or("")))
    throw api::Problem("unsupported-media-type", "Job documents are posted with Content-Type: application/json.");
  const auto coding = content_coding(request.header("content-encoding").value_or(""));
  if (coding) return *coding == Coding::gzip;
  const api::Problem unknown("unsupported-media-type", "Of content codings only gzip and identity are known.");
  reply(problem_answer(unknown, request.target).set("Accept-Encoding", "gzip, identity"));
  return std::nullopt;
}

DocumentCheck::DocumentCheck(Context& context, RequestPtr request, Reply reply, bool packed)
    : context_(context),
      request_(std::move(request)),
      reply_(std::move(reply)),
      packed_(packed),
      until_(context.time.now() + check_time) {}

void DocumentCheck::begin() {
  if (!packed_ && request_->body.size() > large_document) return take_turn();
  context_.checks.post([self = shared_from_this()] {
    try {
      if (!self->quick()) self->take_turn();
    } catch (...) {
      self->reply_(answer_from_current_exception(*self->request_));
    }
  });
}

void DocumentCheck::take_turn() {
  if (request_->listen)
    request_->listen([weak = weak_from_this()] {
      if (const auto self = weak.lock()) self->finish_ = true;
    });
  context_.heavy.post([self = shared_from_this()] {
    try {
      self->thorough();
    } catch (...) {
      self->reply_(answer_from_current_exception(*self->request_));
    }
    give_back_memory();
  });
}

/// Checks a document of some kilobytes; returns false if it is none.
bool DocumentCheck::quick() {
  if (!unpack(large_document)) return false;
  const auto begin = thread_time();
  CheckProgress progress([&] { return thread_time() - begin > quick_check; });
  try {
    if (!check(request_->body, progress)) return false;
  } catch (const std::bad_alloc&) {
    return false;
  }
  done();
  return true;
}

void DocumentCheck::thorough() {
  if (!unpack(context_.max_body))
    throw http_problem(413,
                       "The request body, unpacked, is larger than " + std::to_string(context_.max_body) + " bytes.");
  CheckProgress progress([&] { return finish_ || context_.time.now() >= until_; });
  try {
    const MemoryUse use;
    check(request_->body, progress);
  } catch (const std::bad_alloc&) {
    throw api::Problem("semantic-violation",
                       "The memory that the service may use does not suffice to check the document: divide it, or "
                       "describe it with curves instead of many short lines.");
  }
  done();
}

/// Unpacks the body if it is packed; returns false if it has more than `most` bytes then.
bool DocumentCheck::unpack(std::size_t most) {
  if (!packed_) return true;
  auto text = gunzip(request_->body, most);
  if (!text) return false;
  request_->body = std::move(*text);
  packed_ = false;
  return true;
}

namespace {

class Preview final : public DocumentCheck {
 public:
  using DocumentCheck::DocumentCheck;

 private:
  bool check(std::string_view document, Progress progress) override {
    answer_ = context_.preview(document, progress);
    return answer_.at("checked").get<bool>();
  }
  void done() override { reply_(json_answer(200, answer_)); }

  nlohmann::ordered_json answer_;
};

}  // namespace

void check_document(Context& context, const RequestPtr& request, const Reply& reply) {
  if (const auto packed = packed_document(*request, reply))
    std::make_shared<Preview>(context, request, reply, *packed)->begin();
}

}  // namespace bahnwerk::server
