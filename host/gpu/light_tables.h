#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "prelight/scene.h"
#include "scene/light_sources.h"
#include "shared/shade_types.h"

namespace prelight {

/// Returns lower bounds in [0, 2^32) of intervals with lengths proportional to `weights`, each at least 1, so
/// that every light has a chance. Weights are finite and >= 0; there is at least one and fewer than 2^31.
std::vector<std::uint32_t> makeIntervals(std::span<const double> weights);

/// Returns the probability of an entry of makeIntervals().
double intervalProbability(std::span<const std::uint32_t> bounds, std::size_t entry);

/// Light selection tables of the kernels, as kernels/transport/light_table_funcs.cl describes them. Lights
/// without power are omitted.
struct LightTables {
  std::vector<std::uint32_t> tables;    ///< groups, emitters, sky rows, sky columns per row, profiles
  std::vector<std::uint32_t> emitters;  ///< [emitter], triangle; emitters of one triangle are adjacent
  /// 1/m2, [triangle] or, with parts, [emitter]; empty without emitters.
  std::vector<float> emitterDensities;
  // The following are empty unless emissive triangles have parts (EmissionParts).
  std::vector<std::uint32_t> emitterPartOf;  ///< [emitter], number of the part
  std::vector<glm::vec4> emitterParts;       ///< [emitter], origin and scale
  std::vector<glm::vec4> emitterRadiances;   ///< [emitter]
  std::vector<std::uint32_t> emitterRoots;   ///< [triangle], references to emitters
  /// References to emitters of subdivided triangles and parts.
  std::vector<std::array<std::uint32_t, 4>> emitterNodes;
  std::vector<device::PunctualLight> punctual;
  std::vector<glm::vec4> sky;          ///< [row][column]; empty without a sky
  std::vector<glm::vec4> profiles;     ///< profiles of punctual lights, or empty
  std::vector<double> punctualPowers;  ///< [light], luminance of the power, W
  std::vector<double> emitterPowers;   ///< [emitter], luminance of the power, W
  double emitterPower = 0.0;           ///< sum of emitterPowers
  double skyPower = 0.0;
  std::uint32_t groupCount = 0;
  std::uint32_t emitterGroup = 0;
  std::uint32_t emitterTable = 0;
  std::uint32_t rowTable = 0;
  std::uint32_t columnTable = 0;
  std::uint32_t skyWidth = 0;
  std::uint32_t skyHeight = 0;
};

/// Makes the tables. The power of distant light is the power that enters the bounding sphere of the scene.
/// With `choosePunctual`, the groups contain each punctual light; without, punctual lights are visited in
/// turn and the groups contain only emitters and sky. `sky` may be null.
LightTables makeLightTables(const CompiledScene& scene, const std::vector<Light>& lights,
                            const Environment* sky, bool choosePunctual);

/// Adds the profiles of lights. `lights` are those of the tables' punctual lights, in order.
void addProfiles(std::span<const Light* const> lights, LightTables& tables);

/// Appends emitters, at least one and none of which is in the tables yet, selected in proportion to `powers`,
/// to the tables. After the last call, referToEmitters() must follow.
device::EmitterRange addEmitters(const CompiledScene& scene, std::span<const Emitter> emitters,
                                 std::span<const double> powers, LightTables& tables);

/// Adds the references by which kernels find the emitters of triangles with parts.
void referToEmitters(const CompiledScene& scene, LightTables& tables);

/// The emitters of a triangle in the tables.
struct EmitterRun {
  std::uint32_t triangle = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  double power = 0.0;  ///< luminance, W
};

/// Returns the runs of all emitters, triangle by triangle.
std::vector<EmitterRun> emitterRuns(const LightTables& tables);

/// Returns the turn of a sky for kernels. `rotation` is in radians, counter-clockwise about +Y seen from
/// above.
float skyTurn(double rotation);

/// Returns the layout of the tables. `skyRotation` is as in skyTurn().
device::LightLayout lightLayout(const LightTables& lights, double skyRotation);

}  // namespace prelight
