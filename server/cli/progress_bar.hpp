#pragma once
#include <string>
#include <string_view>

namespace bahnwerk::server::cli {

/// A line on stderr that is rewritten in place; nothing is shown if stderr is not a terminal.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();  ///< clears the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  bool visible() const { return terminal_; }
  void show(double fraction, std::string_view stage, std::string_view message);

 private:
  const bool terminal_;
  bool drawn_ = false;
};

/// Returns "[#####     ]  50 %  stage  message", at most `width` characters, without control characters.
std::string progress_line(double fraction, std::string_view stage, std::string_view message, std::size_t width);

}  // namespace bahnwerk::server::cli
