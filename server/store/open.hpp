#pragma once
#include <functional>
#include <memory>
#include <string>

#include "server/store/store.hpp"

namespace bahnwerk::server {

/// Throws StoreError unless open_store accepts such a URL; opens nothing.
void check_store(const std::string& url);

/// Opens the store named by a URL: sqlite:PATH (a missing directory is created). `observer` receives every commit
/// (seconds, writes); `reserve` bytes of disk are set aside for a full one. Throws StoreError with a sentence for the
/// operator.
std::unique_ptr<Store> open_store(const std::string& url, std::function<void(double, std::size_t)> observer,
                                  std::size_t reserve = 0);

}  // namespace bahnwerk::server
