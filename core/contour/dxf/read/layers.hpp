#pragma once
/// The layers of a drawing: which of them are read, and which of the requested ones do not exist.
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/base/errors.hpp"
#include "core/contour/dxf/read/file.hpp"

namespace bahnwerk {

/// The layers that a file declares and its entities use.
class DxfLayers {
 public:
  struct Layer {
    DxfLayer state;
    bool wanted = true;
  };

  /// `wanted` are the only layers to read, case-insensitive; empty = all.
  explicit DxfLayers(const std::vector<std::string>& wanted);
  /// Adds the layers that the file declares.
  void declare(const DxfFile& file);

  /// Returns the layer of a name as written, so that its lower case is computed once. A name that is looked up counts
  /// as existing.
  const Layer& operator[](std::string_view name);

  /// Returns one fault per wanted name that neither the file declares nor an entity has, at {"contour", "layers",
  /// index}; its message lists the layers that exist.
  std::vector<InputFault> missing() const;

 private:
  std::vector<std::string> wanted_;                     // names in lower case
  std::unordered_map<std::string, DxfLayer> declared_;  // keys are names in lower case
  std::unordered_map<std::string_view, Layer> layers_;  // keys are names as entities write them
};

}  // namespace bahnwerk
