#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight {

/// Steps per period on each side of the table: WAVE_SIDE of
/// host/techniques/vector_occluders/occluder_wave_funcs.cl.
constexpr int waveTableSide = 64;

/// Period of all effects in seconds.
constexpr double effectPeriod = 8.0;

/// Returns a train of plane waves as a table over two phases, [second phase][first phase]: a displacement of
/// length at most 1, and a flicker in [-1,1]. Wave k is a cosine of i_k u + j_k v with integers i_k and j_k,
/// so that the table is periodic. Since u and v advance by whole periods, the train is periodic in time, too
/// (Sherif 2013, 7.3, leaves open how to achieve that). u and v are phases along two oblique axes in space:
/// waves travel in many directions at the cost of one look-up.
std::vector<glm::vec4> makeWaveTable();

/// Returns the value of the shaders' waveAt() in double precision. Phases are in periods.
glm::dvec4 waveAt(std::span<const glm::vec4> table, double first, double second);

/// Returns the phase of the period, [0,1), at a time in seconds.
double effectMoment(double seconds);

}  // namespace prelight
