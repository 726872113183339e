#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "viewer/core/shading.h"

namespace prelight::viewer {

/// A node that is drawn elsewhere than where the file has it.
struct NodeShift {
  int node = 0;        ///< index in the glTF file
  glm::dvec3 by{0.0};  ///< m, world space

  bool operator==(const NodeShift&) const = default;
};

/// The state of a window, for light that follows it.
struct FollowedView {
  std::span<const Light> lights;  ///< world space, as many and of the same types as when the window opened,
                                  ///< then those that were added
  const CompiledScene* scene = nullptr;          ///< as it stands; nullptr: it has not moved
  double skyRotation = 0.0;                      ///< radians about +Y
  std::span<const glm::vec3> groupFactors = {};  ///< [group of the window's]
  std::optional<glm::dvec3> eye = {};            ///< world space, that it is seen from
};

/// Whether two lights at the same place of a list shine alike.
inline bool shinesAs(const Light& a, const Light& b) {
  return a.type == b.type && a.intensity == b.intensity && a.position == b.position &&
         a.direction == b.direction && a.range == b.range && a.radius == b.radius &&
         a.innerConeAngle == b.innerConeAngle && a.outerConeAngle == b.outerConeAngle &&
         a.profile == b.profile && a.side == b.side;
}

class Renderer;

/// Light that follows what moves while a window is open.
class LightFollower {
 public:
  virtual ~LightFollower() = default;

  /// The shading whose light it is.
  virtual Shading shading() const = 0;

  /// Called before every frame of that shading: does a frame's share of the work. True: there is new light.
  /// While it returns false nothing is drawn unless the view changes. OpenGL's state stays as it is.
  virtual bool update(const FollowedView& view) = 0;

  /// False: further calls of update() would bring more, though nothing changes.
  virtual bool settled() const { return true; }

  /// Hands the light over that update() found.
  virtual void show(Renderer& renderer) const = 0;
};

}  // namespace prelight::viewer
