#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/hemisphere_renderer.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"
#include "viewer/hemisphere/disc_pictures.h"
#include "viewer/hemisphere/hemisphere_map.h"
#include "viewer/hemisphere/texel_sums.h"
#include "viewer/scene/vertex_stream.h"

namespace prelight::viewer {

/// A place that looks into the scene.
struct HemisphereReceiver {
  glm::dvec3 position{0.0};                           ///< scene coordinates
  glm::dvec3 normal{0.0};                             ///< unit
  double turn = 0.0;                                  ///< of the map about the normal, radians
  std::uint32_t triangle = DiscReceiver::noTriangle;  ///< that it lies on, for exact edges
  glm::vec3 geometricNormal{0.0f};                    ///< of its triangle
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

/// How edges of triangles are drawn in discs, where they are arcs.
enum class DiscEdges : int {
  Exact,      ///< each texel tests its own direction against the triangle (DiscPictures)
  Pieces,     ///< straight, of triangles cut to a 24th of the scene's diagonal
  Projected,  ///< straight between projected vertices, as Staniszewski has it
};
constexpr std::array<const char*, 3> discEdgeNames = {"exact", "pieces", "projected"};

/// Draws what receivers see by OpenGL, in the place of rays: many receivers' pictures side by side in one,
/// multiplied by what each texel counts, and summed up (Staniszewski 2005, chapter 2; Larsen
/// 2004, chapter 11). Both sides of all triangles are seen; holes of textures are, too, where edges of discs
/// are exact. Every texel counts with its solid angle, which the former leaves out. Sums are over the whole
/// hemisphere: what passes beside a hemi-plane counts as that says.
class HemisphereRaster {
 public:
  /// `side`: texels of a map's picture, a power of two, 8 to 256; `plane`: of hemi-planes. Throws Error for
  /// others, and for a plane without width.
  HemisphereRaster(const CompiledScene& scene, HemisphereMap map, int side,
                   HemisphereSums by = HemisphereSums::MipLevels, const HemiPlane& plane = {},
                   DiscEdges edges = DiscEdges::Exact);

  /// Share of an even sky's light that the map does not see, by its formula.
  double lostShare() const;

  /// Transfer of the visibility of a sky, cosine / pi, in SH of `order` about the world's axes, without
  /// bounces: [receiver][order^2].
  std::vector<double> transfer(std::span<const HemisphereReceiver> receivers, int order);

  /// Returns what receivers see of a sky, relative to what the same texels see of an open one.
  std::vector<HemisphereView> look(std::span<const HemisphereReceiver> receivers, int order);

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
  void draw(const HemisphereFace& face, std::span<const HemisphereReceiver> receivers, bool radiance);
  void drawTriangles(const HemisphereFace& face, std::span<const HemisphereReceiver> receivers);
  std::vector<glm::vec4> sumsOfProducts();
  void addSums(const gl::BufferTexture& weights, std::size_t face, Counts counts, std::span<glm::vec4> sums);
  std::vector<glm::vec4> sums(std::span<const HemisphereReceiver> receivers,
                              std::span<const Weights> weights);
  std::vector<gl::BufferTexture> upload(std::span<const Weights> weights) const;
  std::vector<double> openSums(int order);
  double scale() const;
  std::vector<Weights> transferWeights(int order) const;
  Weights irradianceWeights() const;
  void setRadiance(std::span<const glm::vec3> radiance);

  const CompiledScene& scene_;
  HemisphereMap map_;
  HemiPlane plane_;
  DiscEdges edges_;
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
  std::optional<DiscPictures> discs_;    ///< none: what is drawn are triangles
  std::optional<TexelSums> fourPasses_;  ///< none: mip levels
};

}  // namespace prelight::viewer
