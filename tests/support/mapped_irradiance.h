#pragma once

#include <array>
#include <glm/glm.hpp>

#include "charts/light_map_lookup.h"
#include "prelight/light_map.h"

namespace prelight {

/// Irradiance and, in W/(m2 sr), SH of order 2 of incident radiance, each of three channels.
using MapLight = std::array<glm::dvec3, 5>;

/// Irradiance, W/m2, that a surface of unit normal `normal` gets where a normal map turns it to `mapped`.
///
/// The coefficients give, channel by channel, the integral F of radiance and that of radiance times
/// direction, V, whose part along the normal is the irradiance E. The simplest light with these is taken: an
/// even sky over the surface, of irradiance a, and one far lamp of the rest, d = V - a n. Its a solves |V - a
/// n| = F - 2 a:
///   a = (2 F - E - sqrt((2 F - E)^2 - 3 (F^2 - V^2))) / 3, within 0 to E,
/// and the irradiance is a (1 + m.n) / 2 + max(d.m, 0). It is E for m = n, never negative, and exact for an
/// even sky, for a lamp, and for both together. docs/notes/lightmaps.md compares it to the bands' own
/// irradiance.
glm::dvec3 mappedIrradiance(const MapLight& light, const glm::dvec3& normal, const glm::dvec3& mapped);

/// Of a light map with five coefficients, bilinear.
MapLight incidentLight(const LightMap& map, const LightMapLookUp& at);

}  // namespace prelight
