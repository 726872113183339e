#include "options/shared_bake_options.h"

#include <array>

#include "options/rows.h"
#include "prelight/refine.h"

namespace prelight {

namespace {

using namespace options;
using KeyRow = Rows<AnimationKeys>;
using RefineRow = Rows<RefineRequest>;

constexpr double farthest = 1e9;  // largest distance that options accept, m

constexpr auto lightRows = std::to_array<Option<BakeRequest>>({
    BakeRow::number<&BakeRequest::bounces>(
        whole(0, BakeRequest::maxBounces),
        {.field = "BakeRequest::bounces", .name = "bounces", .help = "diffuse bounces in all transfer"}),
    BakeRow::flag<&BakeRequest::specular>(
        {.field = "BakeRequest::specular",
         .name = "specular-transport",
         .help = "all transfer includes light through glass and from mirrors and metal: caustics that turn "
                 "with the sky, and reflections in mirrors; without it such surfaces count as opaque and "
                 "black",
         .argument = "specular"}),
    BakeRow::flagWith<&BakeRequest::glossyBounces, &BakeRequest::specular>(
        {.field = "BakeRequest::glossyBounces",
         .name = "glossy-bounces",
         .help = "specular transport, and also reflections by the rough lobes of all other materials"}),
    BakeRow::flag<&BakeRequest::subsurface>(
        {.field = "BakeRequest::subsurface",
         .name = "subsurface-transport",
         .help = "AO, SH, CH and Haar transfer include light that passes through surfaces diffusely, as "
                 "through leaves, or is scattered within bodies; without it such surfaces do not show this "
                 "light",
         .argument = "subsurface"}),
});

/// In the order of Visibility.
constexpr auto visibilities = std::to_array<Choice>({
    {"rays", "traced on the OpenCL device"},
    {"raster", "drawn by OpenGL: AO, cones, SH and CH, without bounces"},
});

constexpr auto castRows = std::to_array<Option<BakeRequest>>({
    BakeRow::choice<&BakeRequest::visibility>(visibilities,
                                              {.field = "BakeRequest::visibility",
                                               .name = "visibility",
                                               .help = "how vertices see which directions are open"}),
    BakeRow::number<&BakeRequest::limits, &OcclusionLimits::nearest>(
        real(0, farthest), {.field = "OcclusionLimits::nearest",
                            .name = "near",
                            .help = "surfaces nearer than this occlude nothing, metres",
                            .unit = "m",
                            .argument = "nearest"}),
    BakeRow::number<&BakeRequest::limits, &OcclusionLimits::farthest>(
        real(1e-9, farthest, "no limit"), {.field = "OcclusionLimits::farthest",
                                           .name = "far",
                                           .help = "surfaces farther away than this occlude nothing, metres",
                                           .unit = "m",
                                           .argument = "farthest"}),
    BakeRow::number<&BakeRequest::limits, &OcclusionLimits::obscurance>(
        real(1e-9, farthest, "no fading"),
        {.field = "OcclusionLimits::obscurance",
         .name = "obscurance",
         .help = "occluders fade out linearly with their distance, up to this many metres",
         .unit = "m"}),
    BakeRow::own({.field = "BakeRequest::shadowSets",
                  .name = "shadow-set",
                  .help =
                      "let only these OCCLUDERS cast shadows on these RECEIVERS, and the receivers on "
                      "themselves only if both sides name them: RECEIVERS:OCCLUDERS, each side a list of "
                      "node names or patterns with commas between; repeat it for more; with nothing after "
                      "the colon the receivers have no shadows",
                  .argument = "shadow_sets",
                  .example = "Room*,Floor:Sofa*"}),
    BakeRow::number<&BakeRequest::effort, &Effort::rays>(
        whole(1, BakeRequest::maxRays),
        {.field = "Effort::rays", .name = "rays", .help = "rays per vertex, on average"}),
    BakeRow::number<&BakeRequest::effort, &Effort::error>(
        real(1e-6, 1), {.field = "Effort::error",
                        .name = "error",
                        .help = "stop when the estimated standard error of AO is below this everywhere"}),
    BakeRow::number<&BakeRequest::effort, &Effort::seconds>(
        real(1e-3, 1e7), {.field = "Effort::seconds",
                          .name = "time",
                          .help = "stop after this many seconds of casting",
                          .unit = "s",
                          .argument = "seconds"}),
    BakeRow::own({.field = "BakeRequest::seed",
                  .name = "seed",
                  .help = "seed of the random numbers (default 0); the same seed gives the same bytes"}),
    BakeRow::number<&BakeRequest::maxMemory>(
        {NumberKind::Bytes, 0x1p20, 0x1p50},
        {.field = "BakeRequest::maxMemory",
         .name = "max-memory",
         .help = "memory that the program may use, such as 512M or 8G: stored transport that does not fit is "
                 "kept in a temporary file, and a bake that needs more nevertheless is refused (default: "
                 "about 400 bytes per triangle and 300 MB; a bake is then refused only if this machine has "
                 "too little memory)"}),
});

constexpr auto keyRows = std::to_array<Option<AnimationKeys>>({
    KeyRow::number<&AnimationKeys::count>(
        whole(1, AnimationKeys::mostKeys),
        {.field = "AnimationKeys::count",
         .name = "keys",
         .help = "moments, evenly spaced from the animation's start to its end"}),
    KeyRow::number<&AnimationKeys::error>(
        real(1e-6, 1), {.field = "AnimationKeys::error",
                        .name = "key-error",
                        .help = "instead of a number: as many as keep the relative error between them below "
                                "this"}),
});

constexpr auto refineRows = std::to_array<Option<RefineRequest>>({
    RefineRow::number<&RefineRequest::error>(
        real(1e-3, 1, "none"),
        {.field = "RefineRequest::error",
         .name = "refine",
         .help =
             "cut triangles between whose vertices the light of the sky or of lamps changes by more than "
             "this share of an open sky's (0.01 is usual), so that all techniques show it; the cut meshes "
             "are part of the baked file"}),
    RefineRow::number<&RefineRequest::vertices>(whole(1, 1e8),
                                                {.field = "RefineRequest::vertices",
                                                 .name = "refine-vertices",
                                                 .help = "with refinement: the most vertices to add"}),
});

}  // namespace

std::span<const Option<BakeRequest>> lightOptions() { return lightRows; }

std::span<const Option<BakeRequest>> castOptions() { return castRows; }

template <>
std::span<const Option<AnimationKeys>> optionsOf<AnimationKeys>() {
  return keyRows;
}

template <>
std::span<const Option<RefineRequest>> optionsOf<RefineRequest>() {
  return refineRows;
}

}  // namespace prelight
