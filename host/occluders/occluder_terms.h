#pragma once

#include <glm/glm.hpp>

#include "occluders/occluder_light.h"
#include "occluders/occluder_record.h"

/// The terms of a record in double precision, one function each: the oracle of
/// host/techniques/vector_occluders/occluder_*_funcs.cl. docs/notes/occluders.md derives them.
namespace prelight {

/// Returns the share of a light that a record's shadow takes, [0,1] per channel: 1 minus what passes straight
/// through.
glm::dvec3 shadowOpacity(const OccluderRow& row, const OccluderRecord& record,
                         const OccluderShading& shading);

/// Returns the density of transmitted light by its direction beyond the occluder: von Mises-Fisher, 1/sr.
double causticDensity(const OccluderRecord& record, const glm::dvec3& toLight);

/// Returns the caustic light of a record over pi, for a light at the record's place.
glm::dvec3 causticLight(const OccluderRow& row, const OccluderRecord& record, const IncidentLight& there,
                        const OccluderShading& shading);

/// Returns the factor of a light by Eq. 7.2 and 7.3, bounded.
glm::dvec3 thesisFactor(const OccluderRow& row, const OccluderRecord& record, const glm::dvec3& toLight,
                        const OccluderShading& shading);

/// Returns the light that a record mirrors to a receiver over pi, for a light at the record's place, by
/// either formula.
glm::dvec3 mirroredLight(const OccluderReceiver& receiver, const OccluderRecord& record,
                         const IncidentLight& there, const OccluderShading& shading);

/// Returns the radiance to the eye due to a record's mirroring in a glossy receiver.
glm::dvec3 mirroredAgain(const OccluderReceiver& receiver, const OccluderRecord& record,
                         const IncidentLight& there, const OccluderShading& shading);

/// Returns the reflection of a rough diffuse receiver relative to Lambert's.
double roughDiffuse(const OccluderReceiver& receiver, const glm::dvec3& toLight);

/// Return Cook and Torrance's BRDF with GGX: with f0; and without the Fresnel factor, as the weight of a
/// light in the unshadowed share of reflections, where alpha is at least 0.02.
glm::dvec3 glossyBrdf(const OccluderReceiver& receiver, const glm::dvec3& toLight);
double highlightWeight(const OccluderReceiver& receiver, const glm::dvec3& toLight);

/// Returns the record with occlusion and caustic bent by waves at the receiver.
OccluderRecord bentRecord(const OccluderReceiver& receiver, const OccluderRecord& record,
                          const OccluderEffects& effects);

/// Returns the receiver with its normal bent by the same waves.
OccluderReceiver bentReceiver(const OccluderReceiver& receiver, const OccluderEffects& effects);

/// Returns the factor of a light's colour due to flicker.
glm::dvec3 flickerOf(std::size_t light, const OccluderEffects& effects);

}  // namespace prelight
