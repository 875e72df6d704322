#pragma once
/// The result of a function that may have none for a reason that its caller acts on. Exceptions end a job; this does
/// not.
#include <utility>
#include <variant>

namespace bahnwerk {

/// A value, or the reason why there is none. `T` and `E` are different types.
template <typename T, typename E>
class Expected {
 public:
  Expected(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Expected(E reason) : state_(std::in_place_index<1>, std::move(reason)) {}

  explicit operator bool() const { return state_.index() == 0; }
  /// Return the value; there has to be one.
  T& operator*() & { return *std::get_if<0>(&state_); }
  const T& operator*() const& { return *std::get_if<0>(&state_); }
  T&& operator*() && { return std::move(*std::get_if<0>(&state_)); }
  T* operator->() { return std::get_if<0>(&state_); }
  const T* operator->() const { return std::get_if<0>(&state_); }
  /// Returns the reason; there has to be no value.
  const E& reason() const { return *std::get_if<1>(&state_); }

 private:
  std::variant<T, E> state_;
};

}  // namespace bahnwerk
