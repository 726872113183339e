#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/measured_brdf.h"

namespace prelight::test {

/// BRDF of an isotropic surface whose normal is +Z, 1/sr in three channels.
using Brdf = std::function<glm::dvec3(const glm::dvec3& wo, const glm::dvec3& wi)>;

/// The directions to and from which light is scattered.
struct DirectionPair {
  glm::dvec3 wo, wi;
};

/// Directions at the centres of the cells of MERL's format, in the file's order. Some lie below the surface.
std::vector<DirectionPair> merlDirections();

/// A file in MERL's format that tabulates a BRDF. Below the surface nothing is measured.
std::vector<std::uint8_t> merlFile(const Brdf& brdf);

/// The BRDF tabulated in MERL's format and read again.
MeasuredBrdf tabulated(const Brdf& brdf);

/// GGX with height-correlated Smith masking that reflects `f0` at every microfacet, first bounce only.
Brdf ggxBrdf(const glm::dvec3& f0, double roughness);

/// A material with a measured BRDF, for renderers that follow light.
CompiledMaterial measuredMaterial(std::shared_ptr<const MeasuredBrdf> brdf);

}  // namespace prelight::test
