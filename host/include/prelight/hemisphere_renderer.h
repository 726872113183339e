#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// A point of a surface that looks over its hemisphere.
struct HemispherePlace {
  glm::vec3 position{0.0f};  ///< scene coordinates, lifted off its triangle by the rounding error
  std::uint32_t triangle = 0;
  glm::vec3 normal{0.0f};           ///< unit, axis of the hemisphere
  glm::vec3 geometricNormal{0.0f};  ///< unit, of the triangle, on the side that is looked from
};

/// The sky as a place sees it. With V(w) = 1 in open directions w of the hemisphere and 0 in others, and
/// the integral of f times cosine / pi written as <f>:
struct HemisphereView {
  float open = 0.0f;                  ///< <V>, in [0,1]; exactly 0 or 1 where all directions are alike
  glm::vec3 direction{0.0f};          ///< <(V - open) w>, about the scene's axes
  std::vector<float> harmonics = {};  ///< <(V - open) Y_i(w)>, [order^2], about the scene's axes
};

/// Draws what places of a scene see, for bakes that trace no rays (Visibility::Raster). The library itself
/// has none; openGlHemispheres() of prelight/draw.h makes one.
class HemisphereRenderer {
 public:
  /// Rays that a view stands for: a bake draws as many views as its number of rays divided by this. A view
  /// may test more directions: too few views of a vertex cost more than too few directions of a view.
  static constexpr std::uint32_t directions = 256;

  virtual ~HemisphereRenderer() = default;

  /// Returns what draws and how, for reports and files.
  virtual std::string description() const = 0;

  /// Returns a view per place, with harmonics of `order`, 0: none. Calls come one after the other, but from
  /// any thread.
  virtual std::vector<HemisphereView> look(std::span<const HemispherePlace> places, int order) = 0;
};

/// Makes a renderer of a scene, which outlives it. Throws Error where nothing can draw.
using HemisphereRendererMaker =
    std::function<std::unique_ptr<HemisphereRenderer>(const CompiledScene& scene)>;

}  // namespace prelight
