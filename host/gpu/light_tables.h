#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "prelight/scene.h"
#include "scene/emitters.h"
#include "shared/shade_types.h"

namespace prelight {

/// Lower bounds in [0, 2^32) of intervals whose lengths are in proportion to `weights`, each at least 1, so
/// that nothing that shines is ever left out. Weights are finite and >= 0; at least one entry, fewer than
/// 2^31.
std::vector<std::uint32_t> makeIntervals(std::span<const double> weights);

/// Probability of an entry of makeIntervals().
double intervalProbability(std::span<const std::uint32_t> bounds, std::size_t entry);

/// What kernels choose lights by; kernels/transport/light_table_funcs.cl says how. Lights without power are
/// left out.
struct LightTables {
  std::vector<std::uint32_t> tables;    ///< groups, emitters, sky rows, sky columns a row, profiles
  std::vector<std::uint32_t> emitters;  ///< [emitter] triangle; those of a triangle one after the other
  std::vector<float> emitterDensities;  ///< 1/m2, [triangle], with parts [emitter]; empty without emitters
  // Of scenes whose emissive triangles have parts (EmissionParts); else empty.
  std::vector<std::uint32_t> emitterPartOf;                ///< [emitter] its number there
  std::vector<glm::vec4> emitterParts;                     ///< [emitter] origin and scale
  std::vector<glm::vec4> emitterRadiances;                 ///< [emitter]
  std::vector<std::uint32_t> emitterRoots;                 ///< [triangle] references to emitters
  std::vector<std::array<std::uint32_t, 4>> emitterNodes;  ///< the same of what was cut
  std::vector<device::PunctualLight> punctual;
  std::vector<glm::vec4> sky;          ///< [row][column]; empty without a sky
  std::vector<glm::vec4> profiles;     ///< of punctual lights; empty without such
  std::vector<double> punctualPowers;  ///< [light] luminance of its power, W
  std::vector<double> emitterPowers;   ///< [emitter] the same
  double emitterPower = 0.0;           ///< their sum
  double skyPower = 0.0;
  std::uint32_t groupCount = 0;
  std::uint32_t emitterGroup = 0;
  std::uint32_t emitterTable = 0;
  std::uint32_t rowTable = 0;
  std::uint32_t columnTable = 0;
  std::uint32_t skyWidth = 0;
  std::uint32_t skyHeight = 0;
};

/// Light from afar has the power that enters the sphere around the scene's bounds. With `choosePunctual` the
/// groups hold the punctual lights one by one; without, they are visited in turn and the groups hold only
/// emitters and sky. `sky` may be null.
LightTables makeLightTables(const CompiledScene& scene, const std::vector<Light>& lights,
                            const Environment* sky, bool choosePunctual);

/// Gives lights their profiles: `lights` are those that the tables' punctual ones were made of, in order.
void addProfiles(std::span<const Light* const> lights, LightTables& tables);

/// Adds emitters that one is chosen of in proportion to `powers`, behind those that the tables have. They are
/// at least one, and none has been added before. Next, once all are there: referToEmitters().
device::EmitterRange addEmitters(const CompiledScene& scene, std::span<const Emitter> emitters,
                                 std::span<const double> powers, LightTables& tables);

/// Lets kernels find the emitters of triangles that have parts.
void referToEmitters(const CompiledScene& scene, LightTables& tables);

/// The emitters of a triangle among the tables'.
struct EmitterRun {
  std::uint32_t triangle = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  double power = 0.0;  ///< luminance, W
};

/// All of the tables, triangle by triangle.
std::vector<EmitterRun> emitterRuns(const LightTables& tables);

/// A sky's turn by `rotation`, radians, counter-clockwise about +Y seen from above, as kernels take it.
float skyTurn(double rotation);

/// Where the parts of the tables lie. `skyRotation`: as skyTurn().
device::LightLayout lightLayout(const LightTables& lights, double skyRotation);

}  // namespace prelight
