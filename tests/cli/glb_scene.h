#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace prelight::test {

/// A .glb to be spoiled: JSON and binary chunk of a floor with a smaller roof above it. It has two nodes that
/// share one mesh, a camera and a light.
struct GlbScene {
  nlohmann::ordered_json json;
  std::string bin;

  /// The file's bytes.
  std::string bytes() const;
};

GlbScene floorAndRoof();

/// The floor and the roof with a mesh each; the first or the second mesh has texture coordinates.
GlbScene floorAndRoofWithChart(bool first);

/// A valid .glb with an empty scene.
GlbScene emptyScene();

/// JSON and binary chunk of a .glb's bytes.
GlbScene parseGlb(const std::string& bytes);

/// Values of a tightly packed float accessor.
std::vector<float> floatAccessor(const GlbScene& scene, std::size_t accessor);

}  // namespace prelight::test
