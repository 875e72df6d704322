#pragma once
/// The lowest layer of a DXF file: lines in pairs, a group code and its value. Pairs from one code 0 to the next form a
/// record (a section, a table entry, an entity). Views point into the text. O(bytes), no allocation but the tags.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
namespace bahnwerk {

/// Returns a fault of a DXF file at {"contour","dxf"}: "line 12: …".
InputFault dxf_fault(std::size_t line, const std::string& what);
/// Throws that fault as InvalidInput.
[[noreturn]] void refuse_dxf(std::size_t line, const std::string& what);

/// A group code with its value.
struct DxfTag {
  int code = 0;
  std::string_view value;  ///< value without surrounding white space
  std::size_t line = 0;    ///< line of the value, from 1
};

/// Returns a finite number; throws InvalidInput with the tag's line for anything else.
double dxf_real(const DxfTag& tag);
/// Returns an integer within ±2³¹ (written as one, or as a real number without fraction).
long dxf_integer(const DxfTag& tag);

/// Shortens text of a file for a message and replaces characters that are not printable ASCII by '?'.
std::string dxf_quoted(std::string_view text);

/// The pairs from one group code 0 to the next.
struct DxfRecord {
  std::string_view type;  ///< value of the group code 0
  std::size_t line = 0;   ///< line of that value
  std::vector<DxfTag> tags;
};

/// Reads a text pair by pair, or record by record.
class DxfTags {
 public:
  /// Refuses DWG files. A byte order mark is skipped.
  DxfTags(std::string_view text, Progress progress);

  /// Reads the next pair and skips comments (999). Returns false at the end of the text or at 0x1A, the DOS end mark.
  /// Throws InvalidInput for a group code that is no integer from −5 to 1071, and for a code without a value.
  bool next(DxfTag& tag);
  /// Reads the next record; returns false at the end. Pairs before the first code 0 are skipped. With `keep` false the
  /// tags are not stored.
  bool next(DxfRecord& record, bool keep = true);

  /// The beginning of the next record, for reading it again later.
  struct Mark {
    std::size_t offset = 0, line = 0;
  };
  Mark mark() const;
  void seek(Mark mark);
  /// Returns the text behind the record EOF.
  std::string_view behind_end() const { return behind_; }
  std::size_t line() const { return line_; }       ///< lines read so far
  ProgressScope& progress() { return progress_; }  ///< the scope to which code that works on records reports

 private:
  bool next_line(std::string_view& line);

  std::string_view text_, behind_;
  ProgressScope progress_;
  std::size_t at_ = 0, line_ = 0;
  bool pending_ = false;  ///< whether the last record ended at a code 0, which is in tag_
  DxfTag tag_;
  Mark pending_mark_;
};

}  // namespace bahnwerk
