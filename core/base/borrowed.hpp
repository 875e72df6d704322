#pragma once
/// Shared pointers to objects that another owner keeps alive.
#include <memory>

namespace bahnwerk {

/// Returns a shared pointer to `object`, which has to outlive it. It owns nothing; it serves objects on the stack.
template <class T>
std::shared_ptr<const T> borrowed(const T& object) {
  return {std::shared_ptr<const T>(), &object};
}

}  // namespace bahnwerk
