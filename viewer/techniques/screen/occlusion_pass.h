#pragma once

#include <array>
#include <compare>
#include <glm/glm.hpp>
#include <map>
#include <optional>

#include "viewer/core/occlusion_options.h"
#include "viewer/core/picture_slices.h"
#include "viewer/core/sliced_work.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/programs/shader_variant.h"

namespace prelight::viewer {

/// A picture for which occlusion is computed, in its samples.
struct OcclusionPicture {
  int width = 0, height = 0;
  int margin = 0;        ///< of what lies around it and may occlude
  glm::ivec2 origin{0};  ///< of its lower left corner in the whole picture, of which it may be a tile
  double radius = 0.0;   ///< m
  double slice = PictureSlices::unbounded;  ///< s that a slice of its occlusion may take
};

/// The light of a picture, as far as Ssdo has programs of their own for it.
struct OcclusionLight {
  Features sky;   ///< SkyLight and SkyMap
  int lamps = 0;  ///< whose shadows are found: the first of the Lights block

  auto operator<=>(const OcclusionLight&) const = default;
};

/// How open the surfaces of a picture are, found in the picture itself and a band around it, or among the
/// elements of the scene.
class OcclusionPass {
 public:
  static constexpr int layerCount = 2;
  /// Pixels of what was found around a picture that the filter needs.
  static constexpr int filterReach = 2;
  /// Lamps whose shadows Ssdo finds.
  static constexpr int mostLamps = 4;
  /// Pictures that are found at most: openness or the sky's light, lamps' shadows, the bounce.
  static constexpr int mostOutputs = 3;

  static constexpr GLuint disksUnit = 3;   ///< where draw() looks for elements, if they are to occlude
  static constexpr GLuint fieldsUnit = 4;  ///< and the next one: for fields

  /// The target into which screen_surface.frag has to draw opaque surfaces, cleared to 0, before draw(): the
  /// picture with its margin. The same objects while the size stays.
  const gl::Framebuffer& layer(int index, const OcclusionPicture& picture);

  /// Pictures that draw() finds with options.
  static int outputsOf(const ScreenOcclusionOptions& options);

  /// Finds the light of what sends some, so that it can be drawn into sent(): the picture with its margin.
  SlicedWork drawSenders(OcclusionPicture picture, ScreenOcclusionOptions options, OcclusionLight light);
  const gl::Framebuffer& ofSenders() const { return *ofSenders_.filtered; }

  /// The target into which surfaces have to be drawn, cleared to 0, before draw() gathers it; as large as a
  /// layer.
  const gl::Framebuffer& sent(const OcclusionPicture& picture);

  /// The Frame block in use is of the picture with its margin; of Ssdo, the Lights block is that of the
  /// picture, and the sky's map is bound. `turn`: number of the picture among those whose mean is taken.
  /// Draws found(): outputsOf(options) pictures of every sample. First: mean open direction (of Gtao and
  /// Disks, else 0), scene coordinates, or of Ssdo the sky's irradiance over pi; accessibility. Second, of
  /// Ssdo: which share of each lamp arrives. Third: irradiance over pi from surfaces.
  SlicedWork draw(OcclusionPicture picture, ScreenOcclusionOptions options, OcclusionLight light, int turn);
  const gl::Framebuffer& found() const { return *ofPicture_.filtered; }

 private:
  /// The constants that a program is compiled for.
  struct Variant {
    OcclusionMethod method;
    int layers;
    bool hasThickness;
    bool gathers;
    OcclusionLight light;

    auto operator<=>(const Variant&) const = default;
  };

  /// Occlusion as it was found, and filtered.
  struct Targets {
    std::optional<gl::Framebuffer> found, filtered;
  };

  const gl::Program& programOf(const Variant& variant);
  const gl::Program& filterOf(int outputs);
  SlicedWork find(OcclusionPicture picture, int around, ScreenOcclusionOptions options, OcclusionLight light,
                  int turn, Targets& targets);
  void bindLayers(const ScreenOcclusionOptions& options) const;

  std::map<Variant, gl::Program> programs_;  ///< made when first needed
  std::map<int, gl::Program> filters_;       ///< [outputs]
  gl::VertexArray noVertices_;
  std::array<std::optional<gl::Framebuffer>, layerCount> layers_;
  std::optional<gl::Framebuffer> sent_;
  Targets ofPicture_, ofSenders_;
};

}  // namespace prelight::viewer
