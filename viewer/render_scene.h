#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "viewer/gl/buffer.h"
#include "viewer/gl/texture.h"
#include "viewer/render.h"

namespace prelight::viewer {

/// Vertex attributes, by their location in surface.vert.
enum class Attribute : GLuint {
  Position = 0,          ///< vec3, scene coordinates
  Normal = 1,            ///< vec3, unit
  TexCoords = 2,         ///< vec4: of the base colour, of metalness and roughness
  EmissiveTexCoord = 3,  ///< vec2
  Color = 4,             ///< vec4, linear
  Accessibility = 5,     ///< float, baked AO
  BentNormal = 6,        ///< vec3, baked; zero where the bake has none
};

/// A texture of a material; null is one white texel.
using TextureHandle = const gl::Texture*;

/// How the triangles of a batch look.
struct Surface {
  Material material;
  TextureHandle baseColor = nullptr;
  TextureHandle metallicRoughness = nullptr;
  TextureHandle emissive = nullptr;

  /// Drawn over what lies behind, after everything opaque.
  bool isBlended() const { return material.alphaMode == AlphaMode::Blend || material.transmission > 0.0f; }
};

/// Consecutive triangles of one surface.
struct Batch {
  std::uint32_t surface = 0;
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangleCount = 0;
  glm::vec3 center{0.0f};  ///< of its bounds, to sort what is blended
};

/// A scene and its bake as OpenGL objects of the current context; nothing in it depends on lights or camera.
///
/// Buffer textures (RGBA32F):
/// - triangleNormals: a texel a triangle, geometric normal and 1 where it shades flat, else 0;
/// - transfer: ceil(n^2 / 4) texels a channel, 4 coefficients a texel (zero-padded), channels and then
/// vertices in turn.
class RenderScene {
 public:
  explicit RenderScene(const RenderInputs& inputs);
  RenderScene(const RenderScene&) = delete;  // surfaces point into its textures
  RenderScene& operator=(const RenderScene&) = delete;

  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const std::vector<Batch>& batches() const { return batches_; }
  const gl::VertexArray& vertexArray() const { return vertexArray_; }
  const gl::Texture& triangleNormals() const { return triangleNormals_.texture; }
  const gl::Texture& transfer() const { return transfer_.texture; }
  const gl::Texture& white() const { return white_; }

  int shOrder() const { return shOrder_; }  ///< 0: no transfer
  int shChannels() const { return shChannels_; }
  bool hasAo() const { return hasAo_; }

 private:
  struct LoadedTexture {
    TextureRef use;
    bool srgb = false;
    std::unique_ptr<gl::Texture> texture;
  };

  void makeSurfaces(const RenderInputs& inputs);
  TextureHandle texture(const Scene& scene, const TextureRef& use, bool srgb);
  void makeBatches(const CompiledScene& compiled);
  void makeVertices(const RenderInputs& inputs);
  void makeBaked(const Bake& bake, std::uint32_t vertices);
  template <typename T>
  void addAttribute(Attribute attribute, std::span<const T> values);

  gl::VertexArray vertexArray_;
  std::vector<gl::Buffer> buffers_;
  gl::BufferTexture triangleNormals_;
  gl::BufferTexture transfer_;
  gl::Texture white_;
  std::vector<LoadedTexture> textures_;
  std::vector<Surface> surfaces_;
  std::vector<Batch> batches_;
  int shOrder_ = 0;
  int shChannels_ = 1;
  bool hasAo_ = false;
};

}  // namespace prelight::viewer
