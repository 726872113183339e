#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "transfer/compressed_transfer.h"
#include "transfer/light_map_layout.h"
#include "transfer/transfer.h"
#include "transfer/volume_transfer.h"

namespace prelight {

/// How a bake was made; written to the file's root.
struct BakeInfo {
  std::string generator;
  std::uint64_t seed = 0;
  std::uint64_t rays = 0;  ///< rays cast in all
  double error = 0.0;      ///< estimated standard error of AO, RMS over the surface
  int bounces = 0;
  Plan plan;
  std::string device;
  double seconds = 0.0;
};

/// Baked values of every vertex of a CompiledScene, in its vertex order. A technique that was not asked for
/// is empty.
struct Bake {
  std::vector<float> ao;               ///< [vertex], cosine-weighted accessibility in [0,1], 1 = open
  std::vector<glm::vec3> bentNormals;  ///< [vertex], unit
  std::vector<float> apertures;  ///< [vertex], cosine of half the angle of the cone about the bent normal
                                 ///< that lets through what `ao` says, 0..1
  std::optional<HarmonicTransfer> sh;
  std::optional<CompressedTransfer> compressedSh;  ///< in place of `sh`
  std::optional<HarmonicTransfer> ch;
  std::optional<AnimatedTransfer> animation;  ///< SH at moments; `sh` is that of the rest pose
  std::optional<HaarTransfer> haar;
  std::optional<GlossyTransfer> glossy;
  std::optional<LightGroupTransfer> lightGroups;
  std::optional<OccluderTransfer> occluders;
  std::optional<VolumeTransfer> volume;              ///< of points in the air
  std::optional<ChartTransfer> texels;               ///< of light maps
  std::optional<LightMap> lightMap;                  ///< of the scene's own lights
  std::optional<std::vector<glm::vec3>> irradiance;  ///< [vertex], W/m2 of the scene's static lights
  BakeInfo info;
};

}  // namespace prelight
