#pragma once
/// The layers of a drawing: which of them are read, and which of those asked for do not exist.
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/base/errors.hpp"
#include "core/contour/dxf/read/file.hpp"

namespace bahnwerk {

class DxfLayers {
 public:
  struct Layer {
    DxfLayer state;
    bool wanted = true;
  };

  /// `wanted`: only these, upper and lower case are the same; empty = all.
  explicit DxfLayers(const std::vector<std::string>& wanted);
  /// The layers that the file declares.
  void declare(const DxfFile& file);

  /// By the name as written, so that its lower case is made once. What is asked for counts as existing.
  const Layer& operator[](std::string_view name);

  /// One fault per name that was wanted and that neither the file declares nor an entity has, at {"contour", "layers",
  /// index}; its message lists the layers that exist.
  std::vector<InputFault> missing() const;

 private:
  std::vector<std::string> wanted_;                     // in lower case
  std::unordered_map<std::string, DxfLayer> declared_;  // by the name in lower case
  std::unordered_map<std::string_view, Layer> layers_;  // by the names as written, of entities
};

}  // namespace bahnwerk
