#include "server/cli/progress_bar.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace bahnwerk::server::cli {

std::string progress_line(double fraction, std::string_view stage, std::string_view message, std::size_t width) {
  constexpr std::size_t cells = 24;
  const double part = fraction > 0 ? std::min(fraction, 1.0) : 0.0;  // NaN shows as 0
  const auto filled = static_cast<std::size_t>(part * cells);
  const std::string percent = std::to_string(static_cast<int>(part * 100));
  std::string line = "[" + std::string(filled, '#') + std::string(cells - filled, ' ') + "] " +
                     std::string(3 - percent.size(), ' ') + percent + " %  ";
  for (const std::string_view text : {stage, message})
    if (!text.empty()) line.append(text).append("  ");
  std::erase_if(line, [](unsigned char c) { return c < 32 || c == 127; });
  return line.substr(0, width);
}

ProgressBar::ProgressBar() : terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::cerr << "\r\x1b[K" << std::flush;
}

void ProgressBar::show(double fraction, std::string_view stage, std::string_view message) {
  if (!terminal_) return;
  winsize size{};
  const std::size_t width = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1U : 79U;
  std::cerr << '\r' << progress_line(fraction, stage, message, width) << "\x1b[K" << std::flush;
  drawn_ = true;
}

}  // namespace bahnwerk::server::cli
