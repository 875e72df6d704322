#pragma once
/// The check of a posted document: on the thread that suits its size, within a time, and while the client stays.
#include <atomic>
#include <memory>
#include <optional>

#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// Returns whether the body of a posted document is packed; nullopt, after an answer, for an unknown coding. Throws
/// Problem unsupported-media-type unless the body is JSON, or not-acceptable.
std::optional<bool> packed_document(const Request& request, const Reply& reply);

/// A document on its way through its check.
class DocumentCheck : public std::enable_shared_from_this<DocumentCheck> {
 public:
  DocumentCheck(Context& context, RequestPtr request, Reply reply, bool packed);
  virtual ~DocumentCheck() = default;
  /// Begins the check. It answers an exception, and calls done() once the document is checked, or its time is over.
  void begin();

 protected:
  /// Checks the document; returns false where `progress` stopped that.
  virtual bool check(std::string_view document, Progress progress) = 0;
  virtual void done() = 0;

  Context& context_;
  const RequestPtr request_;
  const Reply reply_;

 private:
  void take_turn();
  bool quick();
  void thorough();
  bool unpack(std::size_t most);

  bool packed_;
  const TimeSource::Time until_;
  std::atomic<bool> finish_{false};  ///< the client has left, or others need the connection
};

/// POST /v1/check: checks a document as POST /v1/jobs does, without a job, and answers what can be said of its plan.
void check_document(Context& context, const RequestPtr& request, const Reply& reply);

}  // namespace bahnwerk::server
