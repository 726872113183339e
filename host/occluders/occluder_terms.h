#pragma once

#include <glm/glm.hpp>

#include "occluders/occluder_light.h"
#include "occluders/occluder_record.h"

/// Terms of a record in double precision, one function each: what kernels/relight/occluder_*_funcs.cl is
/// compared with. docs/occluders.md derives them.
namespace prelight {

/// Share of a light that a record's shadow takes, [0,1] a channel: 1 less what goes straight through.
glm::dvec3 shadowOpacity(const OccluderRow& row, const OccluderRecord& record,
                         const OccluderShading& shading);

/// Density of light that comes through, by its direction beyond the occluder: von Mises-Fisher, 1/sr.
double causticDensity(const OccluderRecord& record, const glm::dvec3& toLight);

/// Light that a record sends along the caustics' way, over pi, for a light at its place.
glm::dvec3 causticLight(const OccluderRow& row, const OccluderRecord& record, const IncidentLight& there,
                        const OccluderShading& shading);

/// Factor of a light by Eq. 7.2 and 7.3, bounded.
glm::dvec3 thesisFactor(const OccluderRow& row, const OccluderRecord& record, const glm::dvec3& toLight,
                        const OccluderShading& shading);

/// Light that a record mirrors to a receiver, over pi, for a light at its place; by either formula.
glm::dvec3 mirroredLight(const OccluderReceiver& receiver, const OccluderRecord& record,
                         const IncidentLight& there, const OccluderShading& shading);

/// Radiance to the eye of what a record mirrors to a glossy receiver.
glm::dvec3 mirroredAgain(const OccluderReceiver& receiver, const OccluderRecord& record,
                         const IncidentLight& there, const OccluderShading& shading);

/// Reflection of a diffuse receiver over Lambert's.
double roughDiffuse(const OccluderReceiver& receiver, const glm::dvec3& toLight);

/// Cook and Torrance's BRDF with GGX: with f0, and without Fresnel's factor as the weight of a light in the
/// share of reflections that shadows leave, where alpha is at least 0.02.
glm::dvec3 glossyBrdf(const OccluderReceiver& receiver, const glm::dvec3& toLight);
double highlightWeight(const OccluderReceiver& receiver, const glm::dvec3& toLight);

/// The record with occlusion and caustic bent by waves at the receiver.
OccluderRecord bentRecord(const OccluderReceiver& receiver, const OccluderRecord& record,
                          const OccluderEffects& effects);

/// The receiver with its normal bent by the same waves.
OccluderReceiver bentReceiver(const OccluderReceiver& receiver, const OccluderEffects& effects);

/// Factor of a light's colour.
glm::dvec3 flickerOf(std::size_t light, const OccluderEffects& effects);

}  // namespace prelight
