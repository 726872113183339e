#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"
#include "viewer/hemisphere/hemisphere_map.h"
#include "viewer/hemisphere/texel_sums.h"
#include "viewer/scene/vertex_stream.h"

namespace prelight::viewer {

/// A place that looks into the scene.
struct HemisphereReceiver {
  glm::dvec3 position{0.0};  ///< scene coordinates
  glm::dvec3 normal{0.0};    ///< unit
};

/// Results of receivers, one after the other.
struct HemisphereGather {
  std::vector<double> transfer;       ///< [receiver][order^2]
  std::vector<glm::vec3> irradiance;  ///< [receiver], W/m2
};

/// How texels of receivers' pictures are summed up.
enum class HemisphereSums {
  MipLevels,   ///< Larsen 2004, 11.1
  FourPasses,  ///< Staniszewski 2005, 2.2.4
};

/// Draws what receivers see by OpenGL, in the place of rays: many receivers' pictures side by side in one,
/// multiplied by what each texel counts, and summed up (Staniszewski 2005, chapter 2; Larsen
/// 2004, chapter 11). Both sides of all triangles are seen, without holes of textures. Every texel counts
/// with its solid angle, which the former leaves out. Sums are over the whole hemisphere: what passes beside
/// a hemi-plane counts as that says.
class HemisphereRaster {
 public:
  /// `side`: texels of a map's picture, a power of two, 8 to 256; `plane`: of hemi-planes. Throws Error for
  /// others, and for a plane without width.
  HemisphereRaster(const CompiledScene& scene, HemisphereMap map, int side,
                   HemisphereSums by = HemisphereSums::MipLevels, const HemiPlane& plane = {});

  /// Share of an even sky's light that the map does not see, by its formula.
  double lostShare() const;

  /// Transfer of the visibility of a sky, cosine / pi, in SH of `order` about the world's axes, without
  /// bounces: [receiver][order^2].
  std::vector<double> transfer(std::span<const HemisphereReceiver> receivers, int order);

  /// Irradiance by surfaces of a radiance, W/(m2 sr), [vertex], the same on both sides: [receiver], W/m2.
  std::vector<glm::vec3> irradiance(std::span<const HemisphereReceiver> receivers,
                                    std::span<const glm::vec3> radiance);

  /// Both of the same pictures, which are drawn once.
  HemisphereGather gather(std::span<const HemisphereReceiver> receivers, int order,
                          std::span<const glm::vec3> radiance);

 private:
  /// A corner of what is drawn.
  struct Corner {
    std::uint32_t triangle;
    glm::vec2 weights;  ///< of the triangle's vertices 1 and 2
  };
  enum class Counts { WhatIsOpen, Radiance };
  /// Weights of texels in one pass of sums.
  struct Weights {
    Counts counts;
    std::vector<glm::vec4> ofTexels;  ///< [face][texel]
  };

  void makeCorners();
  void draw(const HemisphereFace& face, std::span<const HemisphereReceiver> receivers);
  std::vector<glm::vec4> sumsOfProducts();
  void addSums(const gl::BufferTexture& weights, std::size_t face, Counts counts, std::span<glm::vec4> sums);
  std::vector<glm::vec4> sums(std::span<const HemisphereReceiver> receivers,
                              std::span<const Weights> weights);
  double scale() const;
  std::vector<Weights> transferWeights(int order) const;
  Weights irradianceWeights() const;
  void setRadiance(std::span<const glm::vec3> radiance);

  const CompiledScene& scene_;
  HemisphereMap map_;
  HemiPlane plane_;
  int side_;
  int levels_ = 0;      ///< log2 of the side
  int tilesASide_ = 0;  ///< pictures along a side of the atlas
  float nearest_ = 0.0f, farthest_ = 0.0f;
  std::vector<HemisphereFace> faces_;
  std::vector<HemisphereTexel> texels_;
  std::vector<Corner> corners_;
  gl::Program drawProgram_, weighProgram_;
  gl::VertexArray vertices_, noVertices_;
  VertexStream positions_, radiance_;
  gl::Framebuffer atlas_, products_;
  std::optional<TexelSums> fourPasses_;  ///< none: mip levels
};

}  // namespace prelight::viewer
