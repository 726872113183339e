#include <array>

#include "integrators/global_illumination_renderer.h"
#include "integrators/live_virtual_lights.h"
#include "integrators/reference.h"
#include "options/rows.h"

namespace prelight {

namespace {

using namespace options;
using reference::ReferenceRequest;
using Full = GlobalIlluminationPictureRequest;
using FullRow = Rows<GlobalIlluminationPictureRequest>;
using InstantRow = Rows<InstantOptions>;
using ReferenceRow = Rows<ReferenceRequest>;

constexpr double mostPhotons = 1e9;
constexpr double mostVirtualPaths = 1024;  // there is room for their shadow maps
constexpr const char* full = "full";
constexpr const char* instant = "instant";

constexpr std::array<Choice, 3> gatherChoices = {
    {{"all", "from all texels of the map"},
     {"cache", "from some of them, and interpolated for the others"},
     {"guided", "from all, guided by photons"}}};
constexpr std::array<Choice, 2> photonChoices = {
    {{"power", "by the power of lights"}, {"importance", "by their importance for the picture"}}};

/// Rays that are asked for hold whatever the samples of a pixel would suggest.
void setGatherRays(Full& request, double rays) {
  request.indirect.rays = static_cast<std::uint32_t>(rays);
  request.gatherRays = request.indirect.rays;
}

constexpr Option<Full> gatherRays() {
  Option<Full> row = FullRow::number<&Full::indirect, &IndirectRequest::rays>(
      powerOfTwo(8, 65536), {.field = "IndirectRequest::rays",
                             .name = "gather-rays",
                             .help = "rays per texel, a power of two (with denoising and no sky 32 per "
                                     "sample, 128 to 1024)",
                             .shadings = full});
  row.set = setGatherRays;
  return row;
}

constexpr auto fullRows = std::to_array<Option<Full>>({
    FullRow::number<&Full::indirect, &IndirectRequest::photons>(
        whole(1, mostPhotons), {.field = "IndirectRequest::photons",
                                .name = "photons",
                                .help = "number of photons for indirect light (default: 4 per texel of "
                                        "its map, 50,000 to 2 million; 50,000 in windows)",
                                .shadings = full}),
    FullRow::choice<&Full::photonsBy>(photonChoices,
                                      {.field = "GlobalIlluminationPictureRequest::photonsBy",
                                       .name = "photons-by",
                                       .help = "how photons for indirect light are distributed",
                                       .shadings = full}),
    FullRow::number<&Full::causticPhotons>(
        whole(1, mostPhotons), {.field = "GlobalIlluminationPictureRequest::causticPhotons",
                                .name = "caustic-photons",
                                .help = "photons towards mirrors and glass (default: by the picture's size)",
                                .shadings = full}),
    FullRow::number<&Full::texels>(
        whole(1, 1 << 24),
        {.field = "GlobalIlluminationPictureRequest::texels",
         .name = "map-texels",
         .help = "approximate number of texels in the map of indirect light (default: by the size of the "
                 "picture and of the scene)",
         .shadings = full}),
    FullRow::choice<&Full::indirect, &IndirectRequest::gather>(gatherChoices,
                                                               {.field = "IndirectRequest::gather",
                                                                .name = "gather",
                                                                .help = "rays that gather indirect light",
                                                                .shadings = full}),
    gatherRays(),
    FullRow::number<&Full::samples>(whole(1, 64), {.field = "GlobalIlluminationPictureRequest::samples",
                                                   .name = "spp",
                                                   .help = "samples per pixel",
                                                   .argument = "samples",
                                                   .shadings = full}),
});

constexpr auto instantRows = std::to_array<Option<InstantOptions>>({
    InstantRow::number<&InstantOptions::paths>(
        whole(1, mostVirtualPaths),
        {.field = "InstantOptions::paths",
         .name = "virtual-lights",
         .help = "light paths that leave a virtual light wherever they meet a diffuse surface",
         .shadings = instant}),
    InstantRow::number<&InstantOptions::renewals>(
        whole(0, mostVirtualPaths),
        {.field = "InstantOptions::renewals",
         .name = "virtual-renewals",
         .help = "greatest number of light paths that a frame of a window makes anew; 0: all",
         .shadings = instant}),
    InstantRow::number<&InstantOptions::nearest>(
        real(0, 1e6), {.field = "InstantOptions::nearest",
                       .name = "virtual-nearest",
                       .help = "a virtual light that is nearer than this many metres counts as if it were at "
                               "this distance; 0: the radius of the disc that the light represents",
                       .unit = "m",
                       .shadings = instant}),
});

constexpr std::array<Choice, 4> integrators = {{{"whitted", "no diffuse bounce"},
                                                {"distributed", "one diffuse bounce"},
                                                {"path", "all light"},
                                                {"instant", "diffuse bounces from virtual lights"}}};

constexpr auto referenceRows = std::to_array<Option<ReferenceRequest>>({
    ReferenceRow::choice<&ReferenceRequest::integrator>(
        integrators,
        {.field = "ReferenceRequest::integrator", .name = "integrator", .help = "light that is followed"}),
    ReferenceRow::number<&ReferenceRequest::lightPaths>(
        whole(1, 1 << 20), {.field = "ReferenceRequest::lightPaths",
                            .name = "light-paths",
                            .help = "instant: paths per sample that leave virtual lights"}),
    ReferenceRow::number<&ReferenceRequest::depth>(
        whole(1, RenderOptions::maxDepth),
        {.field = "ReferenceRequest::depth",
         .name = "depth",
         .help = "greatest number of segments of a path from camera to light"}),
    ReferenceRow::number<&ReferenceRequest::samples>(
        whole(1, 0xffffffffu),
        {.field = "ReferenceRequest::samples", .name = "spp", .help = "samples per pixel"}),
    ReferenceRow::number<&ReferenceRequest::error>(
        real(1e-6, 1), {.field = "ReferenceRequest::error",
                        .name = "error",
                        .help = "stop when the rms standard error of a pixel is below this share of the "
                                "picture's mean"}),
    ReferenceRow::number<&ReferenceRequest::seconds>(
        real(1e-3, 1e7), {.field = "ReferenceRequest::seconds",
                          .name = "time",
                          .help = "stop at the end of the first pass beyond this many seconds",
                          .unit = "s",
                          .argument = "seconds"}),
    ReferenceRow::own({.field = "Lens::aperture",
                       .name = "aperture",
                       .help =
                           "blur what is out of focus as a lens does: its aperture's diameter in metres, or "
                           "f/2.8 for an f-number, of a camera for 35 mm film (default: a pinhole)",
                       .example = "f/2.8"}),
    ReferenceRow::number<&ReferenceRequest::lens, &reference::Lens::focus>(
        real(1e-6, reference::infiniteFocus),
        {.field = "Lens::focus",
         .name = "focus",
         .help = "depth that a lens shows sharply (default: where the middle of the picture meets the "
                 "scene)",
         .unit = "m"}),
    ReferenceRow::number<&ReferenceRequest::shutter>(
        real(0, 1e6),
        {.field = "ReferenceRequest::shutter",
         .name = "shutter",
         .help =
             "blur what the animation moves while a shutter is open, from the moment on; 0 shows a moment",
         .unit = "s"}),
    ReferenceRow::flag<&ReferenceRequest::guides>(
        {.field = "ReferenceRequest::guides",
         .name = "denoise",
         .help = "remove noise with Intel Open Image Denoise 2, whose library must be installed or named by "
                 "PRELIGHT_OIDN_LIBRARY"}),
});

}  // namespace

template <>
std::span<const Option<GlobalIlluminationPictureRequest>> optionsOf<GlobalIlluminationPictureRequest>() {
  return fullRows;
}

template <>
std::span<const Option<InstantOptions>> optionsOf<InstantOptions>() {
  return instantRows;
}

template <>
std::span<const Option<ReferenceRequest>> optionsOf<ReferenceRequest>() {
  return referenceRows;
}

}  // namespace prelight
