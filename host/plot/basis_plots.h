#pragma once

#include "plot/drawing.h"
#include "prelight/basis.h"

/// Pictures of basis functions.
namespace prelight::plot {

/// Returns the harmonics of an order, 1 to 8, as a pyramid: a row per band, m from -l to l.
Drawing plotHarmonics(HarmonicBasis basis, int order);

/// Returns the Haar wavelets of one face of a cube map of 2, 4 or 8 texels along a side, where the
/// coefficient of each lies in the transformed face: blue is positive, orange negative.
Drawing plotWavelets(int faceSize);

}  // namespace prelight::plot
