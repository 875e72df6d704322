#pragma once
/// Shared pointers to what somebody else owns.
#include <memory>

namespace bahnwerk {

/// Points to `object`, which has to outlive it, and owns nothing: for objects on the stack where shared ones are taken.
template <class T>
std::shared_ptr<const T> borrowed(const T& object) {
  return {std::shared_ptr<const T>(), &object};
}

}  // namespace bahnwerk
