#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "viewer/core/chart_atlas.h"
#include "viewer/core/uniform_blocks.h"
#include "viewer/gl/buffer.h"
#include "viewer/gl/texture.h"
#include "viewer/lights/lighting.h"
#include "viewer/scene/render_scene.h"
#include "viewer/shadows/shadow_pass.h"

namespace prelight::viewer {

/// Shadow maps of lights: depths of the scene as lights see it, in squares of an atlas. Points have a cube of
/// six squares, spots and samples of emitters half a cube of five about their direction, narrow spots one,
/// directional lights one that holds the bounds of the scene.
///
/// Depths are compared with the plane of the surface that is shaded, at the very texel that they stand for:
/// a flat surface casts no shadow on itself however it is slanted, without an offset that would part shadows
/// from what casts them. What is left of one, a share of a texel, follows from the map, so that scenes of
/// all sizes are drawn alike.
class ShadowMaps {
 public:
  static constexpr std::size_t everything = static_cast<std::size_t>(-1);

  /// Squares of samples of large lights that a picture draws where it spreads such work.
  static constexpr std::size_t sampleViewsAPicture = 40;

  /// Which lights have room in the maps.
  enum class Room { OfThoseThatShine, OfAll };

  explicit ShadowMaps(Room room = Room::OfThoseThatShine) : room_(room) {}

  /// How much an update draws.
  struct Effort {
    std::size_t mostSampleViews = everything;  ///< about, of samples of large lights
    bool draft = false;                        ///< maps that are drawn have half as many texels a side
  };

  /// Draws the maps of lights whose place or direction is another than before; all of them where `sceneMoved`
  /// or where other kinds of lights are given. Lights without intensity have none drawn, and
  /// room for one where all have: then they may begin to shine without others being drawn anew. Samples of
  /// large lights that the effort leaves out are drawn in later updates, in turns; their maps are as fine in
  /// drafts. An update that is no draft draws anew what drafts have left. Changes the framebuffer, viewport,
  /// program and depth state in use. Throws Error where OpenGL cannot hold the maps.
  void update(const RenderScene& scene, const CompiledScene& compiled, std::span<const ShadedLight> lights,
              bool sceneMoved, Effort effort);

  /// The next update draws this light's map anew.
  void redraw(std::size_t light) { stale_[light] = true; }

  /// Some maps show what was there before.
  bool isBehind() const;

  /// Some maps are those of a draft.
  bool areCoarse() const;

  /// For the lights of the last update, in their order (shadows/shadows.glsl).
  void bind() const;

  /// The parts that bind() binds: `ShadowLight` of the lights, [view] texels, depths.
  std::vector<ShadowBlock> blocks() const;
  const gl::Texture& views() const { return viewTexels_.texture; }
  const gl::Texture& depths() const { return depths_; }

  std::size_t viewsDrawn() const { return viewsDrawn_; }    ///< squares that the last update drew
  std::size_t texelsDrawn() const { return texelsDrawn_; }  ///< of those squares
  std::size_t viewCount() const { return atlas_.places.size(); }

 private:
  /// Where a light looks from and how: its first view.
  struct Frame {
    ShadowEye eye;
    int views = 0;
    int room = 0;  ///< texels a side that the atlas has for a view
    int side = 0;  ///< of them in use
    std::size_t firstView = 0;

    bool isCoarse() const { return side < room; }
    bool operator==(const Frame&) const = default;
  };

  static Frame frameOf(const ShadedLight& light, const CompiledScene& compiled, int side);
  static Frame coarse(const ShadedLight& light, const CompiledScene& compiled, const Frame& fine);
  std::vector<Frame> framesOf(std::span<const ShadedLight> lights, const CompiledScene& compiled) const;
  std::vector<Frame> prepare(const CompiledScene& compiled, std::span<const ShadedLight> lights,
                             bool sceneMoved, Effort& effort);
  void makeAtlas();
  void uploadFrames();
  void beginDrawing() const;
  static void endDrawing();
  void drawView(const RenderScene& scene, const Frame& frame, int view) const;

  Room room_;
  ShadowPass pass_;
  gl::Texture depths_;
  gl::Object<gl::FramebufferTraits> framebuffer_;
  gl::Buffer lightBlock_;  ///< `ShadowLights` of shadows/shadows.glsl
  gl::BufferTexture viewTexels_;
  std::vector<Frame> frames_;  ///< [light]
  ChartAtlas atlas_;           ///< [view]
  std::vector<bool> stale_;    ///< [light]
  std::size_t next_ = 0;       ///< light that the next update begins with
  std::size_t viewsDrawn_ = 0;
  std::size_t texelsDrawn_ = 0;
};

}  // namespace prelight::viewer
