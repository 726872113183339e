#include <array>

#include "options/rows.h"

namespace prelight {

namespace {

using namespace options;

/// Returns a row for the turn of a sky in radians. The command line takes degrees.
template <typename Options>
constexpr Option<Options> skyRotation(const char* field) {
  return Rows<Options>::template number<&Options::skyRotation>(
      real(-1e4, 1e4), {.field = field,
                        .name = "sky-rotation",
                        .help = "turn of the sky, counter-clockwise seen from above",
                        .unit = "rad",
                        .commandLine = "rotate-env"});
}

constexpr std::array<Choice, 4> methods = {{{"path", "all light"},
                                            {"distributed", "one diffuse bounce"},
                                            {"whitted", "no diffuse bounce"},
                                            {"global-illumination", "photons and final gathering"}}};

constexpr auto renderRows = std::to_array<Option<RenderOptions>>({
    Rows<RenderOptions>::choice<&RenderOptions::method>(methods, {.field = "RenderOptions::method",
                                                                  .name = "method",
                                                                  .help = "how the picture is made",
                                                                  .commandLine = "integrator"}),
    Rows<RenderOptions>::number<&RenderOptions::width>(
        whole(1, RenderOptions::maxSize, "by the camera's aspect"), {.field = "RenderOptions::width",
                                                                     .name = "width",
                                                                     .help = "width of the picture",
                                                                     .unit = "pixels",
                                                                     .commandLine = "size"}),
    Rows<RenderOptions>::number<&RenderOptions::height>(whole(1, RenderOptions::maxSize),
                                                        {.field = "RenderOptions::height",
                                                         .name = "height",
                                                         .help = "height of the picture",
                                                         .unit = "pixels",
                                                         .commandLine = "size"}),
    Rows<RenderOptions>::number<&RenderOptions::samples>(whole(1, 0xffffffffu),
                                                         {.field = "RenderOptions::samples",
                                                          .name = "spp",
                                                          .help = "samples per pixel",
                                                          .argument = "samples"}),
    Rows<RenderOptions>::number<&RenderOptions::depth>(
        whole(1, RenderOptions::maxDepth),
        {.field = "RenderOptions::depth",
         .name = "depth",
         .help = "greatest number of segments of a path from camera to light"}),
    skyRotation<RenderOptions>("RenderOptions::skyRotation"),
});

constexpr auto goalRows = std::to_array<Option<ReferenceGoal>>({
    Rows<ReferenceGoal>::number<&ReferenceGoal::error>(
        real(1e-6, 1), {.field = "ReferenceGoal::error",
                        .name = "error",
                        .help = "stop when the rms standard error of a pixel is below this share of the "
                                "picture's mean"}),
    Rows<ReferenceGoal>::number<&ReferenceGoal::seconds>(
        real(1e-3, 1e7), {.field = "ReferenceGoal::seconds",
                          .name = "time",
                          .help = "stop at the end of the first pass beyond this many seconds",
                          .unit = "s",
                          .argument = "seconds"}),
});

constexpr std::array<Choice, 3> photonKinds = {{{"all", "at every surface that reflects diffusely"},
                                                {"indirect", "after at least one scattering"},
                                                {"caustic", "scattered only by mirrors and glass"}}};

constexpr auto photonRows = std::to_array<Option<PhotonOptions>>({
    Rows<PhotonOptions>::choice<&PhotonOptions::kind>(
        photonKinds,
        {.field = "PhotonOptions::kind", .name = "kind", .help = "photons that are kept where they land"}),
    Rows<PhotonOptions>::number<&PhotonOptions::photons>(
        whole(1, 1e9), {.field = "PhotonOptions::photons",
                        .name = "photons",
                        .help = "approximate number of photons that leave lights"}),
    skyRotation<PhotonOptions>("PhotonOptions::skyRotation"),
});

using LoadRow = Rows<LoadOptions>;

constexpr auto loadRows = std::to_array<Option<LoadOptions>>({
    LoadRow::own({.field = "LoadOptions::scene",
                  .name = "scene",
                  .help = "which of the file's scenes (default: the one that it names, else the first)"}),
    LoadRow::own({.field = "LoadOptions::variant",
                  .name = "variant",
                  .help = "materials of this variant (KHR_materials_variants; default: the one that was "
                          "baked, else the file's own)"}),
    LoadRow::number<&LoadOptions::scale>(
        real(1e-9, 1e9), {.field = "LoadOptions::scale",
                          .name = "scale",
                          .help = "enlarge the scene by this factor, such as 0.001 if it is in millimetres"}),
    LoadRow::own({.field = "LoadOptions::brdfs",
                  .name = "brdf",
                  .help = "let a material, given by name or number, reflect like the measured one in this "
                          "MERL file; may be repeated",
                  .argument = "brdfs"}),
    LoadRow::number<&LoadOptions::at>(
        real(0, 1e6), {.field = "LoadOptions::at",
                       .name = "at",
                       .help = "the scene at this moment of an animation, in seconds (default: as it "
                               "was baked, else at rest)",
                       .unit = "s"}),
    LoadRow::own({.field = "LoadOptions::animation",
                  .name = "animation",
                  .help = "the animation that the moment belongs to (default: the first)"}),
    LoadRow::flag<&LoadOptions::allowOutside>(
        {.field = "LoadOptions::allowOutside",
         .name = "allow-outside",
         .help = "let a scene name buffers, images, profiles and light maps outside of its folder"}),
});

}  // namespace

template <>
std::span<const Option<RenderOptions>> optionsOf<RenderOptions>() {
  return renderRows;
}

template <>
std::span<const Option<ReferenceGoal>> optionsOf<ReferenceGoal>() {
  return goalRows;
}

template <>
std::span<const Option<PhotonOptions>> optionsOf<PhotonOptions>() {
  return photonRows;
}

template <>
std::span<const Option<LoadOptions>> optionsOf<LoadOptions>() {
  return loadRows;
}

}  // namespace prelight
