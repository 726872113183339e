#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "shared/scene_types.h"

namespace prelight {

/// The triangles and vertices of a scene that are stored on the device when instances share shapes, and the
/// map from the scene's triangles to them.
class StoredSurface {
 public:
  StoredSurface() = default;  ///< stores nothing

  /// `instances` are indices into CompiledScene::instances, ascending; if empty, everything is stored.
  StoredSurface(const CompiledScene& scene, std::span<const std::uint32_t> instances);

  const std::vector<device::SurfaceRange>& ranges() const { return ranges_; }

  /// Returns the values of stored triangles, [stored triangle], from values [triangle].
  template <typename T>
  std::vector<T> ofTriangles(std::span<const T> values) const {
    return chosen(values, triangles_);
  }

  /// Returns the values of stored vertices, [stored vertex], from values [vertex], which may be empty.
  template <typename T>
  std::vector<T> ofVertices(std::span<const T> values) const {
    return chosen(values, vertices_);
  }

  /// Returns the stored triangles with indices of stored vertices.
  std::vector<device::DeviceTriangle> triangles(const CompiledScene& scene) const;

 private:
  struct Part {
    std::uint32_t first = 0, count = 0;
  };

  template <typename T>
  static std::vector<T> chosen(std::span<const T> values, const std::vector<Part>& parts) {
    std::vector<T> all;
    if (values.empty()) return all;
    for (const Part& part : parts) {
      const auto of = values.subspan(part.first, part.count);
      all.insert(all.end(), of.begin(), of.end());
    }
    return all;
  }

  void addPart(const Part& triangles, const Part& vertices);

  std::vector<Part> triangles_;  ///< stored one after another
  std::vector<Part> vertices_;   ///< as many parts as triangles_
  std::uint32_t storedTriangles_ = 0;
  std::uint32_t storedVertices_ = 0;
  std::vector<device::SurfaceRange> ranges_;
};

}  // namespace prelight
