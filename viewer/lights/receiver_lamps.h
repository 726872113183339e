#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "basis/lights/lamp_through_transfer.h"
#include "viewer/lights/illumination.h"

/// Lamps at a finite distance whose light comes through a transfer: each receiver gets the exact light of the
/// lamp where nothing is in between, times the share that its transfer leaves in the lamp's direction.
namespace prelight::viewer {

/// Receivers that a thread lights at once.
constexpr std::size_t lampReceivers = 256;

/// Returns the lights of an illumination that come through the transfer.
std::vector<ShadedLight> transferredLights(const Illumination& light);

/// Returns those of them that are at a finite distance.
std::vector<ShadedLight> transferredLamps(const Illumination& light);

/// Returns what a receiver sees of a lamp.
SeenLamp seenFrom(const ShadedLight& lamp, const glm::dvec3& point, const glm::dvec3& normal);

}  // namespace prelight::viewer
