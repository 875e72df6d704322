#include "core/contour/gcode/flow/control.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contour/gcode/words/characters.hpp"

namespace bahnwerk::gcode {

bool Control::fail(std::string why) {
  fault_ = std::move(why);
  return false;
}

const Outline& Control::outline() {
  if (!outline_) outline_.emplace(text_, options_.block_delete, progress_);
  return *outline_;
}

/// Refuses words behind an O word, from `at` on: they would never be carried out.
bool Control::ends(const Line& line, const char* at) {
  for (; at != line.end && *at != ';'; ++at) {
    if (blank(*at)) continue;
    if (*at != '(') return fail("words behind an O word are not carried out: write them in a line of their own");
    while (at + 1 != line.end && *at != ')') ++at;
  }
  return true;
}

bool Control::arguments(const Line& line, std::vector<double>& values) {
  Expression expression(line.arguments, line.end, line.number, parameters_);
  for (;;) {
    expression.skip_blanks();
    if (expression.at() == line.end || *expression.at() != '[') return ends(line, expression.at());
    double value = 0;
    if (values.size() == Parameters::locals) return fail("a subprogram takes 30 values at most");
    if (!expression.value(value)) return fail(expression.fault());
    values.push_back(value);
  }
}

bool Control::condition(const Line& line, double& value) {
  Expression expression(line.arguments, line.end, line.number, parameters_);
  return expression.value(value) ? ends(line, expression.at()) : fail(expression.fault());
}

bool Control::end_of(std::size_t head, Place& place) {
  const std::size_t last = head == Outline::none ? head : outline()[head].last;
  if (last == Outline::none)
    return fail("the O word has no end of its label (endsub, endif, endwhile, endrepeat, while)");
  place = outline()[last].after;
  return true;
}

bool Control::execute(const Line& line) {
  if (outline().full()) return fail("more than 100000 O words");
  const std::size_t index = outline().of_line(line.number);
  const std::size_t from_branch = std::exchange(pending_, Outline::none);
  Place end;
  switch (line.flow) {
    case Flow::sub:
    case Flow::otherwise:
    case Flow::endif:
    case Flow::endloop:
    case Flow::begin:
    case Flow::endrepeat:
    case Flow::stop:
    case Flow::next:
      if (!ends(line, line.arguments)) return false;
      break;
    default:  // statements with values behind them
      break;
  }
  switch (line.flow) {
    case Flow::sub:
      if (index == Outline::none || !end_of(outline()[index].head, end))
        return fail("O sub has no endsub of its label");
      if (outline().subprogram(line.label, false) != index) return fail("the subprogram was defined before");
      lines_.go(end);
      return true;
    case Flow::call:
      return call_sub(line);
    case Flow::leave:
    case Flow::endsub:
      return leave(line);
    default:
      break;
  }
  if (index == Outline::none || outline()[index].head == Outline::none)
    return fail("the O word has no beginning of its label (if, while, do, repeat)");
  const Flow kind = outline()[outline()[index].head].flow;
  const bool of_branch = line.flow == Flow::elseif || line.flow == Flow::otherwise || line.flow == Flow::endif;
  if (of_branch && kind != Flow::branch) return fail("elseif, else and endif need the label of an if");
  switch (line.flow) {
    case Flow::branch:
      return branch(line, index);
    case Flow::elseif:
      if (from_branch == index) return branch(line, index);
      [[fallthrough]];
    case Flow::otherwise:  // reached from the branch before it, which is done
      if (from_branch == index) return true;
      if (!end_of(outline()[index].head, end)) return false;
      lines_.go(end);
      return true;
    case Flow::loop:
    case Flow::endloop:
      return loop(line, index);
    case Flow::repeat:
    case Flow::endrepeat:
      return repeat(line, index);
    case Flow::stop:
    case Flow::next:
      return jump(outline()[index].head, line.flow);
    default:  // do, endif
      return true;
  }
}

/// Executes if and elseif: jumps to the next word of the label if the condition does not hold.
bool Control::branch(const Line& line, std::size_t index) {
  double value = 0;
  Place end;
  if (!end_of(outline()[index].head, end) || !condition(line, value)) return false;
  if (value != 0) return true;
  pending_ = outline()[index].next;
  lines_.go(outline()[pending_].before);
  return true;
}

/// Executes while, endwhile, and the while of a do.
bool Control::loop(const Line& line, std::size_t index) {
  const std::size_t head = outline()[index].head;
  Place end;
  if (!end_of(head, end)) return false;
  const bool at_end = outline()[head].flow == Flow::begin;
  if (line.flow == Flow::endloop) {
    if (at_end || outline()[head].flow != Flow::loop) return fail("endwhile ends no while");
    lines_.go(outline()[head].before);
    return true;
  }
  double value = 0;
  if (!condition(line, value)) return false;
  if (at_end ? value != 0 : value == 0) lines_.go(at_end ? outline()[head].after : end);
  return true;
}

bool Control::repeat(const Line& line, std::size_t index) {
  const std::size_t head = outline()[index].head, outside = frames_.empty() ? 0 : frames_.back().loops;
  Place end;
  if (!end_of(head, end)) return false;
  if (outline()[head].flow != Flow::repeat) return fail("endrepeat ends no repeat");
  const auto under_way = std::find_if(loops_.begin() + static_cast<std::ptrdiff_t>(outside), loops_.end(),
                                      [&](const Loop& one) { return one.head == head; });
  if (line.flow == Flow::repeat) {
    double times = 0;
    if (!condition(line, times)) return false;
    loops_.erase(under_way, loops_.end());  // loops that were left by break, or otherwise
    times = std::floor(times + 1e-6);
    if (times < 1)
      lines_.go(end);
    else
      loops_.push_back({head, times - 1});
    return true;
  }
  if (under_way == loops_.end()) return fail("endrepeat is reached without its repeat");
  loops_.erase(under_way + 1, loops_.end());
  if (under_way->remaining < 1) {
    loops_.pop_back();
  } else {
    under_way->remaining -= 1;
    lines_.go(outline()[head].after);
  }
  return true;
}

/// Executes break and continue.
bool Control::jump(std::size_t head, Flow flow) {
  Place end;
  if (!end_of(head, end)) return false;
  const Flow kind = outline()[head].flow;
  if (kind != Flow::loop && kind != Flow::begin && kind != Flow::repeat)
    return fail("break and continue need the label of a loop");
  if (flow == Flow::stop)
    lines_.go(end);
  else
    lines_.go(kind == Flow::loop ? outline()[head].before : outline()[outline()[head].last].before);
  return true;
}

bool Control::call_sub(const Line& line) {
  const std::size_t head = outline().subprogram(line.label, false);
  if (head == Outline::none) return fail("there is no subprogram O" + line.label + " in the program");
  if (frames_.size() == max_calls) return fail("more than 64 subprograms in one another");
  Place end;
  std::vector<double> values;
  if (!end_of(head, end) || !arguments(line, values)) return false;
  parameters_.set("_value", 0);
  parameters_.set("_value_returned", 0);
  frames_.push_back({lines_.place(), head, 0, loops_.size(), false});
  parameters_.enter(values);
  lines_.go(outline()[head].after);
  return true;
}

/// Executes return and endsub.
bool Control::leave(const Line& line) {
  if (frames_.empty() || frames_.back().numbered) return fail("return and endsub stand in a subprogram (sub)");
  std::vector<double> values;
  if (!arguments(line, values)) return false;
  if (!values.empty()) {
    parameters_.set("_value", values.front());
    parameters_.set("_value_returned", 1);
  }
  parameters_.leave();
  loops_.resize(std::min(loops_.size(), frames_.back().loops));
  lines_.go(frames_.back().back);
  frames_.pop_back();
  return true;
}

bool Control::call(int program, std::size_t repeats) {
  if (outline().full()) return fail("more than 100000 O words");
  std::size_t head = outline().subprogram(std::to_string(program), true);
  // P51002: five times O1002, as older controls write it.
  if (head == Outline::none && program >= 10'000 && repeats == 1) {
    head = outline().subprogram(std::to_string(program % 10'000), true);
    repeats = static_cast<std::size_t>(program / 10'000);
  }
  if (head == Outline::none) return fail("there is no subprogram O" + std::to_string(program) + " in the program");
  if (frames_.size() == max_calls) return fail("more than 64 subprograms in one another");
  const std::size_t first = outline()[head].after.number;
  if (std::find(called_.begin(), called_.end(), first) == called_.end()) called_.push_back(first);
  if (repeats == 0) return true;
  frames_.push_back({lines_.place(), head, repeats - 1, loops_.size(), true});
  lines_.go(outline()[head].after);
  return true;
}

bool Control::back() {
  if (frames_.empty()) return false;
  Frame& frame = frames_.back();
  if (!frame.numbered) return fail("M99 ends a subprogram that is a number alone; O sub ends with endsub");
  loops_.resize(std::min(loops_.size(), frame.loops));
  if (frame.remaining > 0) {
    --frame.remaining;
    lines_.go(outline()[frame.head].after);
    return true;
  }
  lines_.go(frame.back);
  frames_.pop_back();
  return true;
}

}  // namespace bahnwerk::gcode
