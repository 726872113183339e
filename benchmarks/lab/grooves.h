#pragma once

#include "prelight/scene.h"

namespace prelight {

/// Grooves of a sine's profile as a normal texture tells of them, and what places in them see of the sky.
/// Lengths are in texels; grooves lie across the picture's rows.
namespace grooves {

constexpr int texels = 96;  ///< a side of the picture
constexpr double period = 32.0, amplitude = 6.0;

double heightAt(double x);
double slopeAt(double x);

Image normals();

/// Share of an even sky's light that the bumped surface receives there: by midpoints over the sky, and
/// heights marched along each direction.
double openAt(double x);

}  // namespace grooves
}  // namespace prelight
