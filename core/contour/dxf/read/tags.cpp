#include "core/contour/dxf/read/tags.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace bahnwerk {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  return text;
}

/// The whole of `text` as a number.
template <class T>
bool parsed(std::string_view text, T& value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

InputFault dxf_fault(std::size_t line, const std::string& what) {
  return {{"contour", "dxf"}, "line " + std::to_string(line) + ": " + what};
}

void refuse_dxf(std::size_t line, const std::string& what) { throw InvalidInput({dxf_fault(line, what)}); }

std::string dxf_quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string quoted = "\"";
  for (const char c : text.substr(0, longest)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + (text.size() > longest ? "…\"" : "\"");
}

double dxf_real(const DxfTag& tag) {
  double value = 0;
  if (!parsed(tag.value, value) || !std::isfinite(value))
    refuse_dxf(tag.line, dxf_quoted(tag.value) + " (group code " + std::to_string(tag.code) + ") is no finite number");
  return value;
}

long dxf_integer(const DxfTag& tag) {
  constexpr double largest = 2147483648.0;
  long value = 0;
  if (parsed(tag.value, value) && std::abs(static_cast<double>(value)) <= largest) return value;
  double real = 0;
  if (parsed(tag.value, real) && std::abs(real) <= largest && real == std::floor(real)) return static_cast<long>(real);
  refuse_dxf(tag.line, dxf_quoted(tag.value) + " (group code " + std::to_string(tag.code) + ") is no integer");
}

DxfTags::DxfTags(std::string_view text, Progress progress) : text_(text), progress_(progress.part(0, 0), "reading") {
  if (text_.starts_with("AutoCAD Binary DXF"))
    refuse_dxf(1, "this is a binary DXF file whose bytes were changed, as editors and transfers of texts do");
  if (text_.starts_with("AC10")) refuse_dxf(1, "this is a DWG file, not a DXF file; save the drawing as ASCII DXF");
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

bool DxfTags::next_line(std::string_view& line) {
  if (at_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  line = trimmed(text_.substr(at_, end - at_));
  at_ = end + 1;
  ++line_;
  return true;
}

bool DxfTags::next(DxfTag& tag) {
  std::string_view code;
  progress_.work();
  do {
    if (!next_line(code)) return false;
    if (!code.empty() && code.front() == '\x1A') {
      at_ = text_.size();
      return false;
    }
    if (code.empty() && text_.find_first_not_of(" \t\r\n", std::min(at_, text_.size())) == std::string_view::npos) {
      at_ = text_.size();  // blank lines at the end
      return false;
    }
    if (!parsed(code, tag.code) || tag.code < -5 || tag.code > 1071)
      refuse_dxf(line_, dxf_quoted(code) + " is no group code (an integer from -5 to 1071)");
    if (!next_line(tag.value)) refuse_dxf(line_, "the file ends after a group code, without its value");
    tag.line = line_;
  } while (tag.code == 999);
  return true;
}

bool DxfTags::next(DxfRecord& record, bool keep) {
  record.tags.clear();
  while (!pending_) {
    pending_mark_ = {at_, line_};
    if (!next(tag_)) return false;
    pending_ = tag_.code == 0;
  }
  record.type = tag_.value;
  record.line = tag_.line;
  pending_ = false;
  if (record.type == "EOF") {
    behind_ = text_.substr(std::min(at_, text_.size()));
    at_ = text_.size();
    return true;
  }
  for (;;) {
    pending_mark_ = {at_, line_};
    if (!next(tag_)) return true;
    if (tag_.code == 0) {
      pending_ = true;
      return true;
    }
    if (keep) record.tags.push_back(tag_);
  }
}

DxfTags::Mark DxfTags::mark() const { return pending_ ? pending_mark_ : Mark{at_, line_}; }

void DxfTags::seek(Mark mark) {
  at_ = mark.offset;
  line_ = mark.line;
  pending_ = false;
}

}  // namespace bahnwerk
