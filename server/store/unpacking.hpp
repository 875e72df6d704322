#pragma once
/// Errors of stored data.
#include <exception>
#include <new>

#include "server/store/values.hpp"

namespace bahnwerk::server {

/// Runs `work`. Damaged data reads as a failed store, with a sentence, not as a crash.
template <class Work>
auto unpacking(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const StoreError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw StoreError(error.what(), false);
  }
}

}  // namespace bahnwerk::server
