#pragma once
/// Collects impossible parameters of a slot, each under its member's name.
#include <cstdio>
#include <string>
#include <vector>

#include "core/base/errors.hpp"

namespace bahnwerk::winding {

class SlotFaults {
 public:
  void add(const std::string& member, const std::string& message) { list_.push_back({{"slot", member}, message}); }
  void stop_if_any() {
    if (!list_.empty()) throw InvalidInput(list_);
  }
  [[noreturn]] void stop(const std::string& member, const std::string& message) {
    add(member, message);
    throw InvalidInput(list_);
  }
  static std::string mm(double length) {
    char text[40];
    std::snprintf(text, sizeof text, "%.4g mm", length);
    return text;
  }

 private:
  std::vector<InputFault> list_;
};

}  // namespace bahnwerk::winding
