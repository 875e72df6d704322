#include "api/views/views.hpp"

#include <algorithm>
#include <utility>

#include "api/views/envelope_view.hpp"
#include "api/views/limits_view.hpp"
#include "api/views/path_levels.hpp"
#include "api/views/segments.hpp"

namespace bahnwerk::api {
namespace {

using MakeView = std::unique_ptr<View> (*)(const ViewInput& input, const ViewSink& sink);

/// All views; an entry returns nullptr for a series of which the view does not exist. `sink` outlives the view.
constexpr MakeView all_views[] = {make_envelope, make_limits, segment_view, path_view};

}  // namespace

Views::Views(const ViewInput& input, ViewSink sink) : sink_(std::move(sink)) {
  for (const MakeView make : all_views)
    if (auto view = make(input, sink_)) views_.push_back(std::move(view));
}

void Views::add(std::size_t rows, const double* values) {
  for (const auto& view : views_) view->add(rows_, rows, values);
  rows_ += rows;
}

void Views::finish() {
  for (const auto& view : views_) view->finish();
}

void make_views(const ViewInput& input, ViewSink sink,
                const std::function<void(std::size_t first, std::size_t rows, std::vector<double>& out)>& read) {
  constexpr std::size_t rows_at_once = 4096;
  Views views(input, std::move(sink));
  std::vector<double> values;
  for (std::size_t first = 0; first < input.count; first += rows_at_once) {
    const std::size_t rows = std::min(rows_at_once, input.count - first);
    read(first, rows, values);
    views.add(rows, values.data());
  }
  views.finish();
}

}  // namespace bahnwerk::api
