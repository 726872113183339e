#include <array>

#include "parameters/rows.h"

namespace prelight {

namespace {

using namespace parameters;

constexpr auto renderRows = std::to_array<Parameter<RenderOptions>>({
    row<RenderOptions, &RenderOptions::width>({"RenderOptions::width", "",
                                               whole(1, RenderOptions::maxSize, "by the camera's aspect"),
                                               "pixels", "width of the picture"}),
    row<RenderOptions, &RenderOptions::height>(
        {"RenderOptions::height", "", whole(1, RenderOptions::maxSize), "pixels", "height of the picture"}),
    row<RenderOptions, &RenderOptions::samples>(
        {"RenderOptions::samples", "spp", whole(1, 0xffffffffu), "", "samples per pixel"}),
    row<RenderOptions, &RenderOptions::depth>({"RenderOptions::depth", "depth",
                                               whole(1, RenderOptions::maxDepth), "",
                                               "greatest number of segments of a path from camera to light"}),
    row<RenderOptions, &RenderOptions::skyRotation>({"RenderOptions::skyRotation", "", real(-1e4, 1e4), "rad",
                                                     "turn of the sky, counter-clockwise seen from above"}),
});

constexpr auto goalRows = std::to_array<Parameter<ReferenceGoal>>({
    row<ReferenceGoal, &ReferenceGoal::error>(
        {"ReferenceGoal::error", "error", real(1e-6, 1), "",
         "stop when the rms standard error of a pixel is below this share of the picture's mean"}),
    row<ReferenceGoal, &ReferenceGoal::seconds>(
        {"ReferenceGoal::seconds", "time", real(1e-3, 1e7), "s",
         "stop at the end of the first pass beyond this many seconds"}),
});

constexpr auto photonRows = std::to_array<Parameter<PhotonOptions>>({
    row<PhotonOptions, &PhotonOptions::photons>(
        {"PhotonOptions::photons", "", whole(1, 1e9), "", "approximate number of photons that leave lights"}),
    row<PhotonOptions, &PhotonOptions::skyRotation>({"PhotonOptions::skyRotation", "", real(-1e4, 1e4), "rad",
                                                     "turn of the sky, counter-clockwise seen from above"}),
});

constexpr auto loadRows = std::to_array<Parameter<LoadOptions>>({
    row<LoadOptions, &LoadOptions::scale>(
        {"LoadOptions::scale", "scale", real(1e-9, 1e9), "",
         "enlarge the scene by this factor, such as 0.001 if it is in millimetres"}),
    row<LoadOptions, &LoadOptions::at>({"LoadOptions::at", "at", real(0, 1e6), "s",
                                        "load the scene at this moment of an animation, seconds"}),
});

}  // namespace

template <>
std::span<const Parameter<RenderOptions>> parametersOf<RenderOptions>() {
  return renderRows;
}

template <>
std::span<const Parameter<ReferenceGoal>> parametersOf<ReferenceGoal>() {
  return goalRows;
}

template <>
std::span<const Parameter<PhotonOptions>> parametersOf<PhotonOptions>() {
  return photonRows;
}

template <>
std::span<const Parameter<LoadOptions>> parametersOf<LoadOptions>() {
  return loadRows;
}

}  // namespace prelight
