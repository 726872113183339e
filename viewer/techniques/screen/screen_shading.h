#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "viewer/core/view_state.h"
#include "viewer/lights/illumination.h"
#include "viewer/programs/batch_drawer.h"
#include "viewer/techniques/screen/disks/disk_occlusion.h"
#include "viewer/techniques/screen/fields/field_occlusion.h"
#include "viewer/techniques/screen/occlusion_history.h"
#include "viewer/techniques/screen/occlusion_pass.h"

namespace prelight::viewer {

/// A tile of a view, and what around it has to be drawn to find what occludes it.
struct ScreenTile {
  ScreenOcclusionOptions options;
  OcclusionPicture picture;
  Tile whole;       ///< with the band around it
  int samples = 1;  ///< along a side of a pixel
  bool isAllOfView = false;
};

ScreenTile screenTileOf(const View& view, const Tile& tile, const gl::Framebuffer& target,
                        const CompiledScene& scene);

/// How what is found is shown, and under which light.
struct ScreenLook {
  const FrameBlock& frame;  ///< in use: of the tile with its band
  const BatchLook& look;
  const Illumination& light;
};

/// Occlusion and light that are found in pictures, from one picture to the next.
class ScreenShading {
 public:
  /// All outlive it; the device may be null, where fields are not asked for.
  ScreenShading(const CompiledScene& scene, const Device* device, BatchDrawer& batches)
      : scene_(scene), device_(device), batches_(batches) {}

  /// Leaves what is found of every sample of the tile bound for surface.frag, whose textures are. `reuses`:
  /// pictures before may be joined with this one.
  void draw(const ScreenTile& tile, const std::vector<const Batch*>& opaque, const ScreenLook& shown,
            bool reuses);

  /// Vertices of the scene are at other places.
  void sceneMoved();

  /// The next picture of the same view joins more of them.
  bool isBehind() const { return isBehind_; }
  void startPicture() { isBehind_ = false; }

 private:
  void drawLayers(const ScreenTile& tile, const std::vector<const Batch*>& opaque);
  void prepareScene(const ScreenTile& tile, const std::vector<const Batch*>& opaque);
  OcclusionLight lightOf(const ScreenTile& tile, const ScreenLook& shown);
  const gl::Framebuffer& found(const ScreenTile& tile, const OcclusionLight& light, const FrameBlock& frame,
                               bool goesOn);

  const CompiledScene& scene_;
  const Device* device_;
  BatchDrawer& batches_;
  std::unique_ptr<DiskOcclusion> disks_;    ///< made when they first occlude
  std::unique_ptr<FieldOcclusion> fields_;  ///< the same
  OcclusionPass pass_;
  OcclusionHistory history_;
  std::optional<Illumination> light_;  ///< of the last picture that light was found of
  bool moved_ = false;                 ///< the scene has, since occlusion was last found
  bool isBehind_ = false;
};

}  // namespace prelight::viewer
