#include "viewer/options/shading_options.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "occluders/wave_table.h"
#include "options/rows.h"

namespace prelight {
namespace {

using namespace options;

using Row = Rows<ShadingOptions>;

constexpr const char* onScreen = "screen";
constexpr const char* ofLampShadows =  // all that do not show all light
    "phong ao cones horizons thickness screen sh ch haar glossy lights radiosity lightmap vo";
constexpr double farthest = 1e6;  // m
constexpr double mostHaarTerms = 6 * 128 * 128;

template <auto member>
constexpr Option<ShadingOptions> screenNumber(NumberRange range, OptionInfo info) {
  info.shadings = onScreen;
  return Row::number<&ShadingOptions::screenOcclusion, member>(range, info);
}

template <auto... path>
constexpr Option<ShadingOptions> occluderNumber(NumberRange range, OptionInfo info) {
  info.shadings = "vo";
  return Row::number<&ShadingOptions::occluders, path...>(range, info);
}

template <auto... path>
constexpr Option<ShadingOptions> occluderChoice(std::span<const Choice> choices, OptionInfo info) {
  info.shadings = "vo";
  return Row::choice<&ShadingOptions::occluders, path...>(choices, info);
}

constexpr std::array<Choice, 3> corrections = {
    {{"none"},
     {"interreflection", "the light that creases reflect into themselves"},
     {"cubic", "an estimate of it fitted to traced scenes"}}};
constexpr std::array<Choice, 2> filters = {
    {{"cone", "the cone about the bent normal that has this accessibility"},
     {"cosine", "the whole cosine lobe"}}};

constexpr std::array<Choice, 3> lampShadows = {
    {{"auto", "what is baked for the shading, and shadow maps for lamps that it knows nothing of"},
     {"maps", "shadow maps for all lamps"},
     {"baked", "what is baked for the shading, and none where it knows nothing"}}};

constexpr std::array<Choice, 6> occlusionMethods = {
    {{"ssao", "with points"},
     {"hbao", "with horizons"},
     {"gtao", "with slices"},
     {"ssdo", "with slices and the light that arrives through them"},
     {"disks", "with all surfaces of the scene"},
     {"fields", "with a precomputed field of occlusion around each object"}}};
constexpr std::array<Choice, 2> occlusionFilters = {
    {{"none"}, {"bilateral", "averages pixels of one surface"}}};

constexpr std::array<Choice, 2> shadowFormulas = {
    {{"soft"}, {"thesis", "the one of Sherif's thesis (2013)"}}};
constexpr std::array<Choice, 2> mirrorFormulas = {
    {{"lobe", "which conserves energy"}, {"thesis", "the one of Sherif's thesis (2013)"}}};
constexpr std::array<Choice, 2> receivers = {{{"lambert"}, {"oren-nayar", "as rough as their material"}}};
constexpr std::array<Choice, 2> highlights = {{{"metals", "metals and glass"}, {"all", "all surfaces"}}};

constexpr Option<ShadingOptions> horizonSoftness() {
  constexpr double degree = std::numbers::pi / 180.0;
  Option<ShadingOptions> row = Row::number<&ShadingOptions::horizonSoftness>(
      real(0, 45), {.field = "RenderOptions::horizonSoftness",
                    .name = "horizon-softness",
                    .help = "half the angle that the shadows of lamps without a size assume, in degrees; 0: "
                            "hard shadows",
                    .unit = "deg",
                    .shadings = "horizons",
                    .usual = {0, 10}});
  row.get = [](const ShadingOptions& o) { return std::optional<double>(o.horizonSoftness / degree); };
  row.set = [](ShadingOptions& o, double degrees) { o.horizonSoftness = degrees * degree; };
  return row;
}

constexpr Option<ShadingOptions> fieldRays() {
  Option<ShadingOptions> row = screenNumber<&ScreenOcclusionOptions::fieldRays>(
      whole(16, 4096), {.field = "ScreenOcclusionOptions::fieldRays",
                        .name = "occlusion-rays",
                        .help = "fields: rays per cell, rounded up to a power of two",
                        .usual = {16, 1024}});
  row.set = [](ShadingOptions& o, double rays) {
    o.screenOcclusion.fieldRays = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::lround(rays))));
  };
  return row;
}

using Screen = ScreenOcclusionOptions;
using Shaded = OccluderShading;
using Effects = OccluderEffects;

/// The order is that of the window and of the command line's help.
constexpr auto shadingRows = std::to_array<Option<ShadingOptions>>({
    Row::choice<&ShadingOptions::direct>(lampShadows, {.field = "RenderOptions::direct",
                                                       .name = "direct",
                                                       .help = "what shadows lamps and the sun of a sky",
                                                       .shadings = ofLampShadows}),
    Row::number<&ShadingOptions::haarTerms>(
        whole(1, mostHaarTerms, "all"),
        {.field = "RenderOptions::haarTerms",
         .name = "haar-terms",
         .help = "number of light coefficients to keep, the most important ones, with values that make up "
                 "for the others (default: all)",
         .shadings = "haar",
         .usual = {0, 1024}}),
    Row::choice<&ShadingOptions::aoCorrection>(corrections, {.field = "RenderOptions::aoCorrection",
                                                             .name = "ao-correction",
                                                             .help = "light that is added to occluded places",
                                                             .shadings = "ao screen"}),
    Row::choice<&ShadingOptions::aoFilter>(filters, {.field = "RenderOptions::aoFilter",
                                                     .name = "ao-filter",
                                                     .help = "directions over which the sky is averaged",
                                                     .shadings = "ao screen"}),
    horizonSoftness(),
    Row::choice<&ShadingOptions::screenOcclusion, &Screen::method>(
        occlusionMethods, {.field = "ScreenOcclusionOptions::method",
                           .name = "occlusion",
                           .help = "how occlusion is found while drawing",
                           .shadings = onScreen}),
    Row::choice<&ShadingOptions::screenOcclusion, &Screen::filtered>(
        occlusionFilters, {.field = "ScreenOcclusionOptions::filtered",
                           .name = "occlusion-filter",
                           .help = "filter against noise",
                           .shadings = onScreen}),
    screenNumber<&Screen::radius>(
        real(0, farthest), {.field = "ScreenOcclusionOptions::radius",
                            .name = "occlusion-radius",
                            .help = "metres beyond which nothing occludes; 0: a tenth of the diagonal of the "
                                    "scene's bounds",
                            .unit = "m",
                            .usual = {0, 5}}),
    screenNumber<&Screen::slices>(whole(1, 64),
                                  {.field = "ScreenOcclusionOptions::slices",
                                   .name = "occlusion-slices",
                                   .help = "gtao, ssdo: slices through the direction to the eye; hbao: pairs "
                                           "of opposite directions",
                                   .usual = {1, 16}}),
    screenNumber<&Screen::steps>(whole(1, 64),
                                 {.field = "ScreenOcclusionOptions::steps",
                                  .name = "occlusion-steps",
                                  .help = "gtao, ssdo, hbao: pixels examined on each side of a slice",
                                  .usual = {1, 16}}),
    screenNumber<&Screen::samples>(whole(1, 1024), {.field = "ScreenOcclusionOptions::samples",
                                                    .name = "occlusion-samples",
                                                    .help = "ssao: points around a pixel",
                                                    .usual = {1, 128}}),
    screenNumber<&Screen::layers>(whole(1, 2),
                                  {.field = "ScreenOcclusionOptions::layers",
                                   .name = "occlusion-layers",
                                   .help = "gtao, ssdo: 1, only the visible surfaces, as if they had no "
                                           "backs, or 2, also those behind them"}),
    screenNumber<&Screen::thickness>(
        real(0, farthest), {.field = "ScreenOcclusionOptions::thickness",
                            .name = "occlusion-thickness",
                            .help = "gtao, ssdo: thickness in metres of surfaces without a back in the "
                                    "second layer",
                            .unit = "m",
                            .usual = {0, 1}}),
    screenNumber<&Screen::elementSize>(
        real(0, farthest), {.field = "ScreenOcclusionOptions::elementSize",
                            .name = "occlusion-element",
                            .help = "disks: metres of the longest edge of an element that occludes; 0: a "
                                    "quarter of the radius",
                            .unit = "m",
                            .usual = {0, 1}}),
    screenNumber<&Screen::opening>(
        real(0.01, 2), {.field = "ScreenOcclusionOptions::opening",
                        .name = "occlusion-opening",
                        .help = "disks: elements that together are smaller than this share of their distance "
                                "occlude as one",
                        .usual = {0.1, 1}}),
    screenNumber<&Screen::passes>(
        whole(1, 8), {.field = "ScreenOcclusionOptions::passes",
                      .name = "occlusion-passes",
                      .help = "disks: 1, elements behind each other all count; 2, by how open their backs "
                              "are; more repeat that",
                      .usual = {1, 4}}),
    screenNumber<&Screen::bounces>(
        whole(0, 1), {.field = "ScreenOcclusionOptions::bounces",
                      .name = "occlusion-bounces",
                      .help = "ssdo: 1, surfaces in the picture send on what they receive; 0, they only "
                              "occlude"}),
    screenNumber<&Screen::stride>(
        whole(1, 4), {.field = "ScreenOcclusionOptions::stride",
                      .name = "occlusion-stride",
                      .help = "compute occlusion at every n-th pixel in each direction, and filter it to all "
                              "of them",
                      .usual = {1, 2}}),
    screenNumber<&Screen::frames>(
        whole(1, 256), {.field = "ScreenOcclusionOptions::frames",
                        .name = "occlusion-frames",
                        .help = "show the mean of this many pictures with turned samples; windows and "
                                "sequences use the previous ones",
                        .usual = {1, 32}}),
    screenNumber<&Screen::cells>(whole(64, 1 << 21),
                                 {.field = "ScreenOcclusionOptions::cells",
                                  .name = "occlusion-cells",
                                  .help = "fields: approximate number of cells around an object",
                                  .usual = {1 << 9, 1 << 17}}),
    fieldRays(),
    occluderChoice<&OccluderOptions::shading, &Shaded::formula>(
        shadowFormulas,
        {.field = "OccluderShading::formula", .name = "shadow-formula", .help = "formula for shadows"}),
    occluderChoice<&OccluderOptions::shading, &Shaded::mirrors>(
        mirrorFormulas, {.field = "OccluderShading::mirrors",
                         .name = "mirror-formula",
                         .help = "formula for reflections of occluders"}),
    occluderChoice<&OccluderOptions::shading, &Shaded::receiver>(
        receivers, {.field = "OccluderShading::receiver", .name = "receiver", .help = "diffuse surfaces"}),
    occluderChoice<&OccluderOptions::allHighlights>(highlights,
                                                    {.field = "OccluderOptions::allHighlights",
                                                     .name = "highlights",
                                                     .help = "surfaces that mirror lights, with shadows"}),
    occluderNumber<&OccluderOptions::shading, &Shaded::shadowStrength>(
        real(0, 100), {.field = "OccluderShading::shadowStrength",
                       .name = "shadow-strength",
                       .help = "width of the shadows of occluders in the thesis' formula (N_sh); the thesis "
                               "shows 0.2 to 5.5",
                       .usual = {0.2, 5.5}}),
    occluderNumber<&OccluderOptions::shading, &Shaded::causticStrength>(
        real(0, 100), {.field = "OccluderShading::causticStrength",
                       .name = "caustic-strength",
                       .help = "factor for light that glass bends: 1 conserves energy, 0 lets light go "
                               "straight; N_c in the thesis' formula",
                       .usual = {0, 4}}),
    occluderNumber<&OccluderOptions::shading, &Shaded::bleeding>(
        real(-100, 100),
        {.field = "OccluderShading::bleeding",
         .name = "bleeding",
         .help = "factor for light that diffuse occluders reflect; below 0 they drain colour",
         .usual = {-4, 4}}),
    occluderNumber<&OccluderOptions::shading, &Shaded::diffuseFromSpecular>(
        real(0, 100), {.field = "OccluderShading::diffuseFromSpecular",
                       .name = "diffuse-from-specular",
                       .help = "factor for light that shiny occluders mirror onto diffuse surfaces",
                       .usual = {0, 4}}),
    occluderNumber<&OccluderOptions::shading, &Shaded::specularFromSpecular>(
        real(0, 100), {.field = "OccluderShading::specularFromSpecular",
                       .name = "specular-from-specular",
                       .help = "factor for light that shiny occluders mirror onto shiny surfaces",
                       .usual = {0, 4}}),
    occluderNumber<&OccluderOptions::shading, &Shaded::specularExponent>(
        real(1, 1000), {.field = "OccluderShading::specularExponent",
                        .name = "specular-exponent",
                        .help = "cosine power of reflections in a small flat occluder; those in large and "
                                "bent ones are softer"}),
    occluderNumber<&OccluderOptions::shading, &Shaded::effects, &Effects::waves>(
        real(0, 10), {.field = "OccluderEffects::waves",
                      .name = "waves",
                      .help = "bend the directions of shadows and caustics in waves, by angles up to the one "
                              "with this tangent",
                      .usual = {0, 1}}),
    occluderNumber<&OccluderOptions::shading, &Shaded::effects, &Effects::normalWaves>(
        real(0, 10), {.field = "OccluderEffects::normalWaves",
                      .name = "normal-waves",
                      .help = "bend the normals of lit surfaces in the same waves, by angles up to the one "
                              "with this tangent",
                      .usual = {0, 1}}),
    occluderNumber<&OccluderOptions::waveLength>(
        real(0, farthest), {.field = "OccluderOptions::waveLength",
                            .name = "wave-length",
                            .help = "length of the longest wave, metres; 0: half the scene's radius",
                            .unit = "m",
                            .usual = {0, 10}}),
    occluderNumber<&OccluderOptions::shading, &Shaded::effects, &Effects::fire>(
        real(0, 1), {.field = "OccluderEffects::fire",
                     .name = "fire",
                     .help = "part of every light's strength that flickers, and reddens as it sinks"}),
    occluderNumber<&OccluderOptions::seconds>(
        real(-1e6, 1e6), {.field = "OccluderOptions::seconds",
                          .name = "effect-time",
                          .help = "moment of waves and fire, seconds; they repeat every 8",
                          .unit = "s",
                          .usual = {0, effectPeriod}}),
    occluderNumber<&OccluderOptions::skyLights>(whole(1, mostSkyLights),
                                                {.field = "OccluderOptions::skyLights",
                                                 .name = "sky-lights",
                                                 .help = "number of lights that represent the sky",
                                                 .usual = {1, 256}}),
});

constexpr std::array<Choice, 2> lobes = {{{"ggx"}, {"phong", "a power of the cosine"}}};

constexpr auto renderRows = std::to_array<Option<viewer::RenderOptions>>({
    Rows<viewer::RenderOptions>::choice<&viewer::RenderOptions::lobe>(lobes, {.field = "RenderOptions::lobe",
                                                                              .name = "lobe",
                                                                              .help = "shape of reflections",
                                                                              .shadings = "glossy phong"}),
    Rows<viewer::RenderOptions>::choice<&viewer::RenderOptions::debug, &viewer::DebugOptions::shown>(
        viewer::debugChoices, {.field = "RenderOptions::debug",
                               .name = "debug",
                               .help = "show what the picture is computed from, in place of it or over it"}),
    Rows<viewer::RenderOptions>::number<&viewer::RenderOptions::debug, &viewer::DebugOptions::treeDepth>(
        whole(0, viewer::DebugOptions::deepestTree),
        {.field = "DebugOptions::treeDepth",
         .name = "tree-depth",
         .help = "--debug tree: level of the boxes, 0 for the one around everything"}),
});

}  // namespace

template <>
std::span<const Option<ShadingOptions>> optionsOf<ShadingOptions>() {
  return shadingRows;
}

template <>
std::span<const Option<viewer::RenderOptions>> optionsOf<viewer::RenderOptions>() {
  return renderRows;
}

}  // namespace prelight

namespace prelight::viewer {

ShadingOptions withinRanges(ShadingOptions options) {
  for (const Option<ShadingOptions>& row : optionsOf<ShadingOptions>()) {
    if (row.kind != OptionKind::Number) continue;
    const double value = row.get(options).value_or(0.0);
    if (row.range.allows(value)) continue;
    row.set(options,
            std::isnan(value) ? *row.usualValue() : std::clamp(value, row.range.least, row.range.most));
  }
  return options;
}

bool areAnimated(const OccluderOptions& options) {
  const OccluderEffects& effects = options.shading.effects;
  return effects.waves > 0.0 || effects.normalWaves > 0.0 || effects.fire > 0.0;
}

}  // namespace prelight::viewer
