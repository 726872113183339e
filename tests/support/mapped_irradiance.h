#pragma once

#include <array>
#include <glm/glm.hpp>

#include "charts/light_map_lookup.h"
#include "prelight/light_map.h"

namespace prelight {

/// Irradiance and SH of order 2 of incident radiance in W/(m2 sr), with three channels each.
using MapLight = std::array<glm::dvec3, 5>;

/// Irradiance, W/m2, of a surface of unit normal `normal` that a normal map turns to `mapped`.
///
/// For each channel the coefficients give the integral F of radiance and the integral V of radiance times
/// direction, whose part along the normal is the irradiance E. The simplest light with these values is
/// assumed: an even sky over the surface, of irradiance a, and one far lamp with the rest, d = V - a n. The
/// condition |V - a n| = F - 2 a gives
///   a = (2 F - E - sqrt((2 F - E)^2 - 3 (F^2 - V^2))) / 3, within 0 to E,
/// and the irradiance is a (1 + m.n) / 2 + max(d.m, 0). It is E for m = n, never negative, and exact for an
/// even sky, for a lamp, and for both together. docs/notes/lightmaps.md compares it with the irradiance of
/// the bands.
glm::dvec3 mappedIrradiance(const MapLight& light, const glm::dvec3& normal, const glm::dvec3& mapped);

/// Bilinear look-up in a light map with five coefficients.
MapLight incidentLight(const LightMap& map, const LightMapLookUp& at);

}  // namespace prelight
