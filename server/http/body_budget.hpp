#pragma once
/// The memory of request bodies of all connections together.
#include <atomic>
#include <cstddef>
#include <memory>

namespace bahnwerk::server {

class BodyBudget {
 public:
  explicit BodyBudget(std::size_t most) : most_(most) {}

  /// The part of one request, returned with the object.
  class Share {
   public:
    explicit Share(std::shared_ptr<BodyBudget> budget) : budget_(std::move(budget)) {}
    ~Share() { budget_->taken_ -= bytes_; }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;
    /// Returns false if the budget is less than that many more bytes.
    bool add(std::size_t bytes) {
      if ((budget_->taken_ += bytes) > budget_->most_) {
        budget_->taken_ -= bytes;
        return false;
      }
      bytes_ += bytes;
      return true;
    }

   private:
    std::shared_ptr<BodyBudget> budget_;
    std::size_t bytes_ = 0;
  };

 private:
  const std::size_t most_;
  std::atomic<std::size_t> taken_{0};
};

}  // namespace bahnwerk::server
