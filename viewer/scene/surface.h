#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/albedo_table.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "viewer/core/render_inputs.h"
#include "viewer/gl/texture.h"
#include "viewer/scene/triangle_blocks.h"

namespace prelight::viewer {

/// A texture of a material; null where it is not in OpenGL.
using TextureHandle = const gl::Texture*;

/// The uses of textures in a surface.
enum class TextureSlot : std::uint8_t {
  BaseColor,
  MetallicRoughness,
  Emissive,
  Normal,
  Transmission,
  Specular,
  SpecularColor,
  Coat,
  CoatRoughness,
  CoatNormal,
  SheenColor,
  SheenRoughness,
  Anisotropy,
  Film,
  FilmThickness
};

constexpr std::size_t surfaceTextures = static_cast<std::size_t>(TextureSlot::FilmThickness) + 1;

struct SurfaceTexture {
  TextureHandle texture = nullptr;
  TextureRef use;     ///< no image: one white texel
  bool srgb = false;  ///< its colours are
};

/// How the triangles of a batch look.
struct Surface {
  Material material;
  std::array<SurfaceTexture, surfaceTextures> textures;

  glm::vec3 absorption{0.0f};    ///< inside a body, 1/m
  glm::vec4 translucency{0.0f};  ///< light that comes through diffusely: colour x share, share
  std::uint32_t filmTable = 0;   ///< where that of its film begins in albedos()
  std::uint32_t glassTable = 0;  ///< the same of what its glass scatters
  int measured = -1;             ///< as measuredNumbers()
  float passes = 0.0f;           ///< share of a light that goes straight through it, of thin glass
  bool showsSurroundings =
      false;  ///< mirrors, glass, narrow lobes and metals, which reflect nothing diffusely
  bool showsNarrowLobes = false;  ///< mirrors, smooth glass and lobes that show edges of what lies around
  bool reflectsAround = false;    ///< mirrors, and layers of a roughness below 0.5 or with a coat

  const SurfaceTexture& at(TextureSlot slot) const { return textures[static_cast<std::size_t>(slot)]; }
  bool has(TextureSlot slot) const { return at(slot).use.image >= 0; }

  /// Glass with an inside.
  bool isBody() const { return material.transmission > 0.0f && material.thickness > 0.0f; }

  /// Drawn over what lies behind, after everything opaque.
  bool isBlended() const { return material.alphaMode == AlphaMode::Blend || material.transmission > 0.0f; }
};

/// Surfaces of the scene's materials, [material], without their tables and textures in OpenGL.
std::vector<Surface> surfacesOf(const RenderInputs& inputs);

/// Makes the look-up tables of lobes that surfaces read, and tells the surfaces where theirs begin; none
/// where nothing reflects specularly.
SceneAlbedos surfaceAlbedos(const CompiledScene& compiled, std::vector<Surface>& surfaces);

/// [material]: number of its measured BRDF among those of the scene that do not reflect diffusely alone; -1:
/// it has none.
std::vector<int> measuredNumbers(const CompiledScene& scene);

/// Consecutive triangles of one surface.
struct Batch {
  std::uint32_t surface = 0;
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangleCount = 0;
  glm::vec3 center{0.0f};   ///< of its bounds, to sort what is blended
  int node = -1;            ///< of a surface that shows its surroundings: the glTF node it belongs to
  int reflectingNode = -1;  ///< the same of one that reflects what lies around it

  TriangleRange triangles() const { return {firstTriangle, triangleCount}; }
};

/// The batches of a scene, in the order of its triangles.
std::vector<Batch> batchesOf(const CompiledScene& compiled, const std::vector<Surface>& surfaces);

/// The middle of its bounds.
glm::vec3 centerOf(const CompiledScene& compiled, const Batch& batch);

/// [triangle], geometric normal, and 1 where it shades flat, else 0.
std::vector<glm::vec4> geometricNormals(const CompiledScene& compiled);

}  // namespace prelight::viewer
