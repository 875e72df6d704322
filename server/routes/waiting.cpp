#include "server/routes/waiting.hpp"

#include <algorithm>

#include "server/http/answer.hpp"

namespace bahnwerk::server {

std::function<void()> AnyJobWait::look_again() {
  return [self = shared_from_this()] { self->pool_.post([self] { self->look(); }); };
}

bool AnyJobWait::changed(std::uint64_t seen) const {
  try {
    return context_.store.last_change() != seen;
  } catch (...) {
    return true;
  }
}

void AnyJobWait::look() {
  try {
    const std::uint64_t seen = context_.store.last_change();
    if (auto response = look_(finished_ || context_.draining || context_.time.now() >= until_)) {
      response->set("Preference-Applied", "wait=" + std::to_string(wait_));
      return reply_(std::move(*response));
    }
    if (request_->listen && !std::exchange(listening_, true)) {
      request_->listen([weak = weak_from_this()] {
        if (const auto alive = weak.lock()) {
          alive->finished_ = true;
          alive->context_.notifier.wake(alive->token_);
        }
      });
    }
    const auto until = again_ ? std::min(until_, context_.time.now() + *again_) : until_;
    token_ = context_.notifier.wait(std::string(Notifier::any_job), until, look_again());
    // A change between the query and the wait would be missed.
    if (finished_ || changed(seen)) context_.notifier.wake(token_);
  } catch (const StoreError& error) {
    if (!error.busy || finished_ || context_.draining || context_.time.now() >= until_)
      return reply_(answer_from_current_exception(*request_));
    token_ = context_.notifier.wait("", std::min(until_, context_.time.now() + store_retry), look_again());
    if (finished_) context_.notifier.wake(token_);
  } catch (...) {
    reply_(answer_from_current_exception(*request_));
  }
}

}  // namespace bahnwerk::server
