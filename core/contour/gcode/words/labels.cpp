// O words with their labels, and values that are no plain numbers.
#include <algorithm>
#include <cmath>

#include "core/contour/gcode/words/characters.hpp"
#include "core/contour/gcode/words/words.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr const char* no_parameters = "parameters and expressions are not read here";

struct Keyword {
  std::string_view word;
  Flow flow;
};
constexpr Keyword keywords[] = {{"SUB", Flow::sub},
                                {"ENDSUB", Flow::endsub},
                                {"CALL", Flow::call},
                                {"RETURN", Flow::leave},
                                {"IF", Flow::branch},
                                {"ELSEIF", Flow::elseif},
                                {"ELSE", Flow::otherwise},
                                {"ENDIF", Flow::endif},
                                {"WHILE", Flow::loop},
                                {"ENDWHILE", Flow::endloop},
                                {"DO", Flow::begin},
                                {"REPEAT", Flow::repeat},
                                {"ENDREPEAT", Flow::endrepeat},
                                {"BREAK", Flow::stop},
                                {"CONTINUE", Flow::next}};

}  // namespace

bool Lines::next_label(Line& line) {
  if (at_ == end_) return false;
  line.number = ++number_;
  line.letters_ = 0;
  line.flow = Flow::none;
  line.slash = false;
  line.label.clear();
  skip_blanks();
  if (at_ != end_ && *at_ == '/') {
    line.slash = true;
    ++at_;
    skip_blanks();
    if (at_ != end_ && *at_ >= '1' && *at_ <= '9') ++at_;
    skip_blanks();
  }
  for (; at_ != end_ && *at_ == '('; skip_blanks()) comment(line);
  if (at_ != end_ && capital(*at_) == 'N') {
    ++at_;
    while (at_ != end_ && (blank(*at_) || part_of_number(*at_))) ++at_;
  }
  if (at_ != end_ && (capital(*at_) == 'O' || *at_ == ':')) {
    ++at_;
    skip_blanks();
    // A computed label is none to go to.
    if (at_ != end_ && *at_ != '[' && *at_ != '#') label(line);
    line.fault.clear();
  }
  end_line();
  return true;
}

/// Reads what follows the letter O: a number or a name, and what it does. Returns false if nothing more of the line is
/// to be read.
bool Lines::label(Line& line) {
  line.letters_ |= letters("O");
  line.values_['O' - 'A'] = 0;
  line.label.clear();
  skip_blanks();
  const char* first = at_;
  if (at_ != end_ && (*at_ == '<' || *at_ == '[' || *at_ == '#')) {
    if (*at_ == '<') {
      for (++at_; at_ != end_ && !end_of_line(*at_) && *at_ != '>'; ++at_)
        if (!blank(*at_)) line.label += capital(*at_);
      if (at_ != end_ && *at_ == '>')
        ++at_;
      else
        line.fault = "a name does not end: > is missing";
    } else {
      double value = 0;
      if (!computed(line, value)) return false;
      if (value >= 0 && value < 1e9) line.label = std::to_string(std::lround(value));
    }
    if (line.label.empty() && line.fault.empty()) line.fault = "an O word needs a number or a name";
    if (!line.fault.empty()) return false;
  } else {
    while (at_ != end_ && (part_of_number(*at_) || blank(*at_))) {
      if (!blank(*at_) && !(line.label.empty() && *at_ == '0')) line.label += *at_;
      ++at_;
    }
    if (line.label.empty()) {
      if (std::find(first, at_, '0') == at_) {
        const bool name = at_ != end_ && (is_letter(*at_) || *at_ == '_');
        line.fault = name ? no_word(first - 1) : "the letter O has no number";
        return false;
      }
      line.label = "0";
    }
  }
  skip_blanks();
  const char* word = at_;
  while (word != end_ && is_letter(*word)) ++word;
  for (const Keyword& keyword : keywords) {
    const auto size = static_cast<std::size_t>(word - at_);
    if (size != keyword.word.size() ||
        !std::equal(at_, word, keyword.word.begin(), [](char a, char b) { return capital(a) == b; }))
      continue;
    line.flow = keyword.flow;
    line.arguments = at_ = word;
    return false;
  }
  return true;
}

const char* Lines::line_end() {
  if (line_end_ == nullptr) line_end_ = std::find_if(at_, end_, end_of_line);
  return line_end_;
}

/// Reads an assignment after its #.
bool Lines::assignment(Line& line) {
  if (parameters_ == nullptr) {
    line.fault = no_parameters;
    return false;
  }
  Expression expression(at_, line_end(), number_, *parameters_);
  Expression::Reference to;
  double value = 0;
  const bool read = expression.reference(to) && expression.next_is('=') && expression.value(value);
  at_ = expression.at();
  if (!read)
    line.fault = expression.fault().empty() ? "a parameter (#) stands behind a letter, or gets its value with ="
                                            : expression.fault();
  else if (Parameters::system(to.number) && to.name.empty())
    line.fault = "the parameters #5021 to #5029 and #5161 to #5602 are kept by the control: they cannot be set";
  else if (!to.name.empty() && parameters_->kept(to.name))
    line.fault = "the parameter #<" + to.name + "> is kept by the control: it cannot be set";
  else
    assigned_.emplace_back(std::move(to), value);
  if (assigned_.size() > Line::max_assignments) line.fault = "a line sets 64 parameters at most";
  return line.fault.empty();
}

/// Reads a value that is no plain number.
bool Lines::computed(Line& line, double& value) {
  if (parameters_ == nullptr) {
    line.fault = no_parameters;
    return false;
  }
  Expression expression(at_, line_end(), number_, *parameters_);
  if (!expression.value(value)) line.fault = expression.fault();
  at_ = expression.at();
  return line.fault.empty();
}

}  // namespace bahnwerk::gcode
