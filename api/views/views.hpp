#pragma once
/// Views of a series: small data, made in one pass over all rows, from which charts and pages are answered without
/// reading the rows again. A view is a name and numbered parts of bytes. A store keeps the parts beside the setpoints
/// and reads them by name and number; what the bytes mean is the view's own matter.
///
/// A new view is a class derived from View, a line in the list of views.cpp, and, if it changes what is stored, the
/// next views_version.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/setpoint_source.hpp"

namespace bahnwerk::api {

struct ViewFacts;  // api/views/view_facts.hpp

/// Version of what is stored; views of another version are made again at the first question.
inline constexpr int views_version = 1;

struct ViewPart {
  std::string name;
  std::size_t part = 0;
  std::string bytes;
};
/// Receives the parts of all views, each once; the store compresses them.
using ViewSink = std::function<void(ViewPart)>;
/// Returns the bytes of a part; nullopt if there is no such part.
using ViewReader = std::function<std::optional<std::string>(std::string_view name, std::size_t part)>;

/// What is known of a series before its rows are read.
struct ViewInput {
  std::vector<Column> columns;
  std::size_t count = 0;
  double cycle_time = 0;
  std::shared_ptr<const ViewFacts> facts = nullptr;  ///< what the document says; nullptr: nothing
};

/// Makes one view.
class View {
 public:
  virtual ~View() = default;
  /// Receives rows [first, first + rows), row-major with all columns. All rows come in order, a few thousand at a time.
  virtual void add(std::size_t first, std::size_t rows, const double* values) = 0;
  /// Is called once, after the last row.
  virtual void finish() = 0;
};

/// Makes all views of a series. Memory: that of a few parts of each view.
class Views {
 public:
  Views(const ViewInput& input, ViewSink sink);
  Views(const Views&) = delete;
  Views& operator=(const Views&) = delete;
  /// Receives the next rows.
  void add(std::size_t rows, const double* values);
  void finish();

 private:
  ViewSink sink_;
  std::vector<std::unique_ptr<View>> views_;
  std::size_t rows_ = 0;
};

/// Makes all views of a series of which `read` returns the rows, for jobs that were stored without them.
void make_views(const ViewInput& input, ViewSink sink,
                const std::function<void(std::size_t first, std::size_t rows, std::vector<double>& out)>& read);

}  // namespace bahnwerk::api
