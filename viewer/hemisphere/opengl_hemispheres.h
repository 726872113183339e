#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/threads.h"
#include "prelight/hemisphere_renderer.h"
#include "viewer/gl/egl_context.h"
#include "viewer/hemisphere/hemisphere_raster.h"

namespace prelight::viewer {

/// Draws views of a bake's receivers by OpenGL without a display: a disc of 32 x 32 texels each, turned about
/// the normal by chance, so that neighbours do not miss the same directions. OpenGL has a thread of its own,
/// because its contexts belong to threads.
class OpenGlHemispheres final : public HemisphereRenderer {
 public:
  /// The scene outlives it. Throws Error where there is no OpenGL, or too little of it for the scene.
  explicit OpenGlHemispheres(const CompiledScene& scene);
  ~OpenGlHemispheres() override;

  std::string description() const override { return description_; }
  std::vector<HemisphereView> look(std::span<const HemispherePlace> places, int order) override;

 private:
  /// Performs work in OpenGL's thread and waits for it. Throws what it throws.
  void run(const std::function<void()>& work);

  std::string description_;
  std::optional<gl::EglContext> context_;
  std::optional<HemisphereRaster> raster_;
  BackgroundWork thread_{1};  ///< last: it ends before what it uses
};

}  // namespace prelight::viewer
