#include "viewer/options/occlusion_parameters.h"

#include <array>
#include <bit>
#include <cmath>

namespace prelight::viewer {
namespace {

using Screen = ScreenOcclusionOptions;

template <auto member>
double get(const Screen& o) {
  return o.*member;
}
template <double Screen::*member>
void setReal(Screen& o, double value) {
  o.*member = value;
}
template <int Screen::*member>
void setWhole(Screen& o, double value) {
  o.*member = static_cast<int>(std::lround(value));
}

void setPowerOfTwo(Screen& o, double value) {
  o.fieldRays = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::lround(value))));
}

constexpr std::array<ScreenOcclusionParameter, 14> screenParameterTable = {{
    {"--occlusion-radius", "radius, m", 0.0, 1e6, 0.0, 5.0,
     "metres beyond which nothing occludes; 0: a tenth of the diagonal of the scene's bounds",
     get<&Screen::radius>, setReal<&Screen::radius>},
    {"--occlusion-slices", "slices", 1, 64, 1, 16,
     "gtao, ssdo: slices through the direction to the eye; hbao: pairs of opposite directions",
     get<&Screen::slices>, setWhole<&Screen::slices>, true},
    {"--occlusion-steps", "steps", 1, 64, 1, 16, "gtao, ssdo, hbao: pixels examined on each side of a slice",
     get<&Screen::steps>, setWhole<&Screen::steps>, true},
    {"--occlusion-samples", "samples", 1, 1024, 1, 128, "ssao: points around a pixel", get<&Screen::samples>,
     setWhole<&Screen::samples>, true},
    {"--occlusion-layers", "layers", 1, 2, 1, 2,
     "gtao, ssdo: 1, only the visible surfaces, as if they had no backs, or 2, also those behind them",
     get<&Screen::layers>, setWhole<&Screen::layers>, true},
    {"--occlusion-thickness", "thickness, m", 0.0, 1e6, 0.0, 1.0,
     "gtao, ssdo: thickness in metres of surfaces without a back in the second layer",
     get<&Screen::thickness>, setReal<&Screen::thickness>},
    {"--occlusion-element", "element, m", 0.0, 1e6, 0.0, 1.0,
     "disks: metres of the longest edge of an element that occludes; 0: a quarter of the radius",
     get<&Screen::elementSize>, setReal<&Screen::elementSize>},
    {"--occlusion-opening", "opening", 0.01, 2.0, 0.1, 1.0,
     "disks: elements that together are smaller than this share of their distance occlude as one",
     get<&Screen::opening>, setReal<&Screen::opening>},
    {"--occlusion-passes", "passes", 1, 8, 1, 4,
     "disks: 1, elements behind each other all count; 2, by how open their backs are; more repeat that",
     get<&Screen::passes>, setWhole<&Screen::passes>, true},
    {"--occlusion-bounces", "bounces", 0, 1, 0, 1,
     "ssdo: 1, surfaces in the picture send on what they receive; 0, they only occlude",
     get<&Screen::bounces>, setWhole<&Screen::bounces>, true},
    {"--occlusion-stride", "every n-th pixel", 1, 4, 1, 2,
     "compute occlusion at every n-th pixel in each direction, and filter it to all of them",
     get<&Screen::stride>, setWhole<&Screen::stride>, true},
    {"--occlusion-frames", "frames", 1, 256, 1, 32,
     "show the mean of this many pictures with turned samples; windows and sequences use the previous ones",
     get<&Screen::frames>, setWhole<&Screen::frames>, true},
    {"--occlusion-cells", "cells", 64, 1 << 21, 1 << 9, 1 << 17,
     "fields: approximate number of cells around an object", get<&Screen::cells>, setWhole<&Screen::cells>,
     true},
    {"--occlusion-rays", "rays", 16, 4096, 16, 1024, "fields: rays per cell, rounded up to a power of two",
     get<&Screen::fieldRays>, setPowerOfTwo, true},
}};

}  // namespace

std::span<const ScreenOcclusionParameter> screenOcclusionParameters() { return screenParameterTable; }

}  // namespace prelight::viewer
