#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "shared/scene_types.h"
#include "shared/shade_types.h"

namespace prelight {

/// Collects textures as kernels read them (kernels/transport/alpha_funcs.cl), one use of an image at a time.
class TextureUpload {
 public:
  /// `images` are accessed until the last add().
  explicit TextureUpload(std::span<const Image> images) : images_(images) {}

  /// Adds a use of an image and returns its index in the textures, or PRELIGHT_NO_TEXTURE for no image.
  /// `srgb` says how its colours are stored. Texels of an image are stored once.
  std::uint32_t add(const TextureRef& use, bool srgb);

  std::vector<device::DeviceTexture> takeTextures() { return std::move(textures_); }
  std::vector<glm::u16vec4> takeTexels() { return std::move(texels_); }  ///< linear, in 1/65535

 private:
  std::uint32_t texelsOf(int image, bool srgb);

  std::span<const Image> images_;
  std::map<std::pair<int, bool>, std::uint32_t> offsets_;
  std::vector<device::DeviceTexture> textures_;
  std::vector<glm::u16vec4> texels_;
};

/// Material data that rays and bounces need.
struct SurfaceArrays {
  std::vector<device::DeviceMaterial> materials;
  std::vector<device::DeviceTexture> textures;
  std::vector<glm::u16vec4> texels;  ///< linear RGBA in 1/65535, all images one after another
};

/// Returns whether any triangle has each material, [material]. Textures of other materials are not uploaded.
std::vector<bool> usedMaterials(const CompiledScene& scene);

SurfaceArrays makeSurfaceArrays(const CompiledScene& scene);

/// Returns the value of DeviceMaterial::flags.
std::uint32_t surfaceFlags(const CompiledMaterial& material);

/// Returns whether a metalness or transmission that the albedo depends on has a texture:
/// PRELIGHT_ALBEDO_SHARES.
bool albedoHasShares(const CompiledScene& scene);

/// Returns position and normal of every vertex, [vertex][6].
std::vector<float> interleaveVertices(const CompiledScene& scene);

/// Returns tangents, [triangle][corner], as kernels/transport/interaction_funcs.cl reads them; empty if no
/// material needs any.
std::vector<std::uint32_t> packTangents(const CompiledScene& scene);

/// Material data of light transport, with textures.
struct ShadeArrays {
  /// Base colours, for surfaceColor() of kernels/transport/alpha_funcs.cl.
  std::vector<device::DeviceMaterial> bases;
  std::vector<device::ShadeMaterial> materials;
  std::vector<device::DeviceTexture> textures;
  std::vector<glm::u16vec4> texels;  ///< linear, in 1/65535
  std::vector<glm::vec4> albedos;    ///< makeAlbedoTable(); empty if nothing reflects with roughness
  std::vector<float> measured;       ///< measured BRDFs, as kernels/transport/measured_funcs.cl reads them
};

/// `images` are Scene::images.
ShadeArrays makeShadeArrays(const CompiledScene& scene, const std::vector<Image>& images);

/// Returns only the material data of panes that shadow rays need, with the textures that the scene keeps for
/// it.
ShadeArrays makePaneArrays(const CompiledScene& scene);

/// Returns material data without textures: only factors count.
ShadeArrays makePlainShadeArrays(const CompiledScene& scene);

}  // namespace prelight
