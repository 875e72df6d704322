#include "core/contour/gcode/flow/outline.hpp"

#include <algorithm>

#include "core/base/progress.hpp"

namespace bahnwerk::gcode {

Outline::Outline(std::string_view text, bool skip_slash, Progress progress) {
  constexpr std::size_t lines_per_report = 65'536;  // 10 to 100 ns each
  Lines lines(text);
  Line line;
  std::map<std::string, std::size_t> open;  // the last one of each chain that has not ended
  for (Place before = lines.place(); lines.next_label(line); before = lines.place()) {
    if (line.number % lines_per_report == 0) progress.report("reading", 0);
    if (!line.has('O') || (line.slash && skip_slash)) continue;
    full_ = entries_.size() == most;
    if (full_) return;
    entries_.push_back({before, lines.place(), line.flow, none, none, none});
    link(line.label, entries_.size() - 1, open);
  }
}

void Outline::link(const std::string& label, std::size_t index, std::map<std::string, std::size_t>& open) {
  Entry& entry = entries_[index];
  const auto chain = open.find(label);
  const bool goes_on = chain != open.end();
  const auto extend = [&] {
    if (!goes_on) return false;
    entry.head = entries_[chain->second].head;
    entries_[chain->second].next = index;
    chain->second = index;
    return true;
  };
  const auto close = [&] {
    if (!extend()) return;
    entries_[entry.head].last = index;
    open.erase(chain);
  };
  switch (entry.flow) {
    case Flow::none:
      numbers_.emplace(label, index);
      return;
    case Flow::sub:
      subs_.emplace(label, index);
      [[fallthrough]];
    case Flow::branch:
    case Flow::begin:
    case Flow::repeat:
      entry.head = index;
      open[label] = index;
      return;
    case Flow::loop:  // ends a do
      if (goes_on && entries_[entries_[chain->second].head].flow == Flow::begin) return close();
      entry.head = index;
      open[label] = index;
      return;
    case Flow::elseif:
    case Flow::otherwise:
      extend();
      return;
    case Flow::endsub:
    case Flow::endif:
    case Flow::endloop:
    case Flow::endrepeat:
      return close();
    case Flow::stop:
    case Flow::next:
      if (goes_on) entry.head = entries_[chain->second].head;
      return;
    case Flow::call:
    case Flow::leave:
      return;
  }
}

std::size_t Outline::of_line(std::size_t number) const {
  const auto at = std::lower_bound(entries_.begin(), entries_.end(), number,
                                   [](const Entry& entry, std::size_t n) { return entry.after.number < n; });
  return at != entries_.end() && at->after.number == number ? static_cast<std::size_t>(at - entries_.begin()) : none;
}

std::size_t Outline::subprogram(const std::string& label, bool numbered) const {
  const auto& list = numbered ? numbers_ : subs_;
  const auto at = list.find(label);
  return at == list.end() ? none : at->second;
}

}  // namespace bahnwerk::gcode
