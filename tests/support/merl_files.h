#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/measured_brdf.h"

namespace prelight::test {

/// Of an isotropic surface whose normal is +Z, 1/sr in three channels.
using Brdf = std::function<glm::dvec3(const glm::dvec3& wo, const glm::dvec3& wi)>;

/// Two directions that light goes between.
struct DirectionPair {
  glm::dvec3 wo, wi;
};

/// Those that the middles of the cells of MERL's format stand for, in the file's order; some lie below the
/// surface.
std::vector<DirectionPair> merlDirections();

/// A file in MERL's format that tabulates a BRDF; nothing is measured below the surface.
std::vector<std::uint8_t> merlFile(const Brdf& brdf);

/// The same, read.
MeasuredBrdf tabulated(const Brdf& brdf);

/// GGX with height-correlated Smith masking that reflects `f0` at every microfacet, at the first bounce.
Brdf ggxBrdf(const glm::dvec3& f0, double roughness);

/// A material of a measured BRDF for all that follows light.
CompiledMaterial measuredMaterial(std::shared_ptr<const MeasuredBrdf> brdf);

}  // namespace prelight::test
