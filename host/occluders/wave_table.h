#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight {

/// Steps of a period along each side of the table: WAVE_SIDE of kernels/relight/occluder_wave_funcs.cl.
constexpr int waveTableSide = 64;

/// Seconds after which all effects repeat.
constexpr double effectPeriod = 8.0;

/// A train of plane waves as a table over two phases, [second phase][first phase]: displacement, at most 1
/// long, and a flicker in [-1,1]. Wave k is a cosine of i_k u + j_k v with whole i_k and j_k, so that the
/// table closes on itself, and with u and v growing by whole periods over time the train does too (Sherif
/// 2013, 7.3, leaves open how to make it periodic). u and v are phases along two oblique axes in space:
/// waves travel in many directions, and cost one look-up.
std::vector<glm::vec4> makeWaveTable();

/// What the shaders' waveAt() yields, in double precision. Phases in periods.
glm::dvec4 waveAt(std::span<const glm::vec4> table, double first, double second);

/// Part of the period that has passed at a time in seconds, [0,1).
double effectMoment(double seconds);

}  // namespace prelight
