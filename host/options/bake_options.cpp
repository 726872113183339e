#include <array>

#include "options/rows.h"

namespace prelight {

namespace {

using namespace options;
using Row = Rows<BakeRequest>;
using KeyRow = Rows<AnimationKeys>;

constexpr double farthest = 1e9;                          // largest distance that options accept, m
constexpr double largestCell = 1e6, smallestCell = 1e-6;  // m, for texels and elements

constexpr std::array<Choice, 4> occluderKinds = {{{"node"}, {"mesh"}, {"material"}, {"auto"}}};
constexpr std::array<Choice, 4> solvers = {{{"jacobi"}, {"chebyshev"}, {"gauss-seidel"}, {"southwell"}}};

/// Sets a flag that includes another one.
template <bool BakeRequest::*flag, auto... included>
void setWith(BakeRequest& request, double value) {
  request.*flag = value != 0.0;
  if (value != 0.0) (request.*....*included) = true;
}

/// Returns a row whose flag includes the one at the end of a path.
template <bool BakeRequest::*flag, auto... included>
constexpr Option<BakeRequest> including(const OptionInfo& info) {
  Option<BakeRequest> row = Row::flag<flag>(info);
  row.set = setWith<flag, included...>;
  return row;
}

void setCaustics(BakeRequest& request, double value) {
  request.lightMap.caustics = value != 0.0;
  if (value != 0.0) request.lightMap.wanted = true;
}

constexpr Option<BakeRequest> caustics() {
  Option<BakeRequest> row = Row::flag<&BakeRequest::lightMap, &LightMapRequest::caustics>(
      {.field = "LightMapRequest::caustics",
       .name = "caustics",
       .help = "light map with caustics, the light that mirrors and glass focus, from photons sent towards "
               "them"});
  row.set = setCaustics;
  return row;
}

/// The order is that of the command line's help.
constexpr auto bakeRows = std::to_array<Option<BakeRequest>>({
    Row::flag<&BakeRequest::ao>(
        {.field = "BakeRequest::ao", .name = "ao", .help = "ambient occlusion and bent normal"}),
    including<&BakeRequest::cones, &BakeRequest::ao>(
        {.field = "BakeRequest::cones",
         .name = "cones",
         .help = "ambient occlusion and bent normal with the angle of the open cone about the bent normal, "
                 "which shadows sky, lights and reflections"}),
    Row::number<&BakeRequest::horizons, &HorizonsRequest::sectors>(
        whole(BakeRequest::minSectors, BakeRequest::maxSectors, "none"),
        {.field = "HorizonsRequest::sectors",
         .name = "horizons",
         .help = "horizon angles in this many sectors of azimuth around the normal (8 is usual), to shadow "
                 "sky, lights and reflections"}),
    Row::number<&BakeRequest::sh, &ShRequest::order>(
        whole(1, BakeRequest::maxShOrder, "none"),
        {.field = "ShRequest::order",
         .name = "sh",
         .help = "spherical-harmonic transfer of this order (order squared coefficients)"}),
    Row::number<&BakeRequest::ch, &ChRequest::order>(
        whole(1, BakeRequest::maxShOrder, "none"),
        {.field = "ChRequest::order", .name = "ch", .help = "cpherical-harmonic transfer of this order"}),
    Row::flag<&BakeRequest::ch, &ChRequest::naive>(
        {.field = "ChRequest::naive",
         .name = "ch-naive",
         .help = "store plain inner products with the cpherical harmonics, which are not orthogonal: for "
                 "comparison"}),
    Row::number<&BakeRequest::nearLamps, &NearLampsRequest::shells>(
        whole(2, BakeRequest::maxShells, "none"),
        {.field = "NearLampsRequest::shells",
         .name = "near-lamps",
         .help = "shadows of lamps within the scene, too, from the rays of SH or CH transfer, with this many "
                 "shells of distance (8 is usual)"}),
    Row::number<&BakeRequest::haar, &HaarRequest::size>(
        powerOfTwo(1, BakeRequest::maxHaarSize, "none"),
        {.field = "HaarRequest::size",
         .name = "haar",
         .help = "Haar wavelet transfer on cube maps with this many texels along a side of a face, a power "
                 "of two"}),
    Row::number<&BakeRequest::haar, &HaarRequest::error>(
        real(0, 1), {.field = "HaarRequest::error",
                     .name = "haar-error",
                     .help = "relative error that is allowed when wavelets are dropped"}),
    Row::number<&BakeRequest::glossy, &GlossyRequest::order>(
        whole(1, BakeRequest::maxGlossyOrder, "none"),
        {.field = "GlossyRequest::order",
         .name = "glossy",
         .help = "transfer matrices of glossy surfaces, of this order (with its fourth power of entries)"}),
    Row::flag<&BakeRequest::lightGroups, &LightGroupsRequest::wanted>(
        {.field = "BakeRequest::lightGroups",
         .name = "light-groups",
         .help = "transfer of the scene's own lights, each of which can be scaled and coloured at run time"}),
    Row::own({.field = "LightGroupRequest::name",
              .name = "light-group",
              .help = "group of lights that change together: NAME=PATTERN[,PATTERN...], with patterns (* and "
                      "?) for names of lights or nodes; repeat it for more groups; every other light is a "
                      "group of its own",
              .example = "lamps=Lamp*,Bulb"}),
    Row::flag<&BakeRequest::occluders, &OccluderRequest::wanted>(
        {.field = "BakeRequest::occluders",
         .name = "vo",
         .help = "vector occluders: what every vertex sees of each object, for shadows and colour bleeding"}),
    Row::choice<&BakeRequest::occluders, &OccluderRequest::kind>(
        occluderKinds,
        {.field = "OccluderRequest::kind",
         .name = "vo-kind",
         .help = "what forms one occluder: node (default), mesh, material, or auto:N, parts of nodes, chosen "
                 "for every vertex so that there are N records per vertex on average",
         .commandLine = "occluders",
         .example = "auto:8"}),
    Row::number<&BakeRequest::occluders, &OccluderRequest::records>(
        real(1, 256), {.field = "OccluderRequest::records",
                       .name = "vo-records",
                       .help = "average records per vertex if parts of nodes are chosen as occluders",
                       .commandLine = "occluders auto:N"}),
    Row::number<&BakeRequest::occluders, &OccluderRequest::leastFormFactor>(
        real(0, 1), {.field = "OccluderRequest::leastFormFactor",
                     .name = "vo-min-form-factor",
                     .help = "drop occluders of a vertex that hide less of its sky than this"}),
    Row::flag<&BakeRequest::radiosity, &RadiosityRequest::wanted>(
        {.field = "BakeRequest::radiosity",
         .name = "radiosity",
         .help = "irradiance of the scene's own lights at every vertex, direct and through all diffuse "
                 "bounces"}),
    Row::number<&BakeRequest::radiosity, &RadiosityRequest::patchSize>(
        real(smallestCell, largestCell, "chosen by the scene"),
        {.field = "RadiosityRequest::patchSize",
         .name = "patch-size",
         .help = "radiosity: longest edge of an element, metres; larger triangles are cut (default: "
                 "thousands of elements)",
         .unit = "m"}),
    Row::choice<&BakeRequest::radiosity, &RadiosityRequest::method>(
        solvers, {.field = "RadiosityRequest::method",
                  .name = "solver",
                  .help = "radiosity: method that solves for the light of all elements"}),
    Row::number<&BakeRequest::radiosity, &RadiosityRequest::tolerance>(
        real(1e-7, 0.5),
        {.field = "RadiosityRequest::tolerance",
         .name = "tolerance",
         .help = "radiosity: stop solving at this residual, a share of the direct light's power"}),
    Row::number<&BakeRequest::radiosity, &RadiosityRequest::skyRotation>(
        real(-1e4, 1e4), {.field = "RadiosityRequest::skyRotation",
                          .name = "sky-rotation",
                          .help = "turn of the sky, counter-clockwise seen from above",
                          .unit = "rad",
                          .commandLine = "rotate-env"}),
    Row::own({.field = "RadiosityRequest::environment",
              .name = "sky",
              .help = "sky for radiosity and light maps; ignored with a warning for transfer, which does not "
                      "depend on it",
              .commandLine = "env"}),
    Row::flag<&BakeRequest::lightMap, &LightMapRequest::wanted>(
        {.field = "BakeRequest::lightMap",
         .name = "lightmap",
         .help = "light map: irradiance of the scene's own lights, direct and through all bounces, in an "
                 ".exr beside the file and at the vertices; charts are made for all meshes",
         .argument = "light_map"}),
    Row::number<&BakeRequest::lightMap, &LightMapRequest::texelSize>(
        real(smallestCell, largestCell, "chosen by the scene"),
        {.field = "LightMapRequest::texelSize",
         .name = "texel-size",
         .help = "light map: side of a texel, metres (default: such that there are 65 thousand texels, and "
                 "up to a million if the surface has many pieces); with a texel error the side of the "
                 "smallest",
         .unit = "m"}),
    Row::number<&BakeRequest::lightMap, &LightMapRequest::error>(
        real(1e-4, 1, "texels of one size"),
        {.field = "LightMapRequest::error",
         .name = "texel-error",
         .help = "light map: choose a texel size for each chart, such that the rms error between texels is "
                 "about this share of the chart's mean light; the smallest texels are a quarter of the usual "
                 "size"}),
    Row::flag<&BakeRequest::lightMap, &LightMapRequest::denoise>(
        {.field = "LightMapRequest::denoise",
         .name = "denoise",
         .help = "light map, and full shading of render: remove noise with Intel Open Image Denoise 2, whose "
                 "library must be installed or named by PRELIGHT_OIDN_LIBRARY"}),
    Row::own({.field = "EncodedLightRequest::encodings",
              .name = "encode",
              .help = "light map: also store how the light at texels and vertices depends on direction, for "
                      "normal maps, in the encodings NAME[,NAME...]",
              .example = "ambient-cube,sh"}),
    caustics(),
    Row::number<&BakeRequest::lightMap, &LightMapRequest::photons>(
        whole(1, 1e9, "chosen by the texels"),
        {.field = "LightMapRequest::photons",
         .name = "photons",
         .help = "light map: photons that leave lights, and as many towards mirrors and glass (default: four "
                 "per texel, sixteen with denoising)"}),
    Row::number<&BakeRequest::volume, &VolumeRequest::size>(
        whole(1, BakeRequest::maxVolumeSize, "none"),
        {.field = "VolumeRequest::size",
         .name = "volume",
         .help = "SH transfer of points in the air, on a grid of this many voxels along the scene's longest "
                 "side (32 is usual)"}),
    Row::number<&BakeRequest::chartTransfer, &ChartTransferRequest::size>(
        whole(1, BakeRequest::maxChartSize, "none"),
        {.field = "ChartTransferRequest::size",
         .name = "texels",
         .help = "SH transfer at texels, too, with the normals of normal maps: texels along a side of the "
                 "largest map"}),
    Row::flag<&BakeRequest::chartTransfer, &ChartTransferRequest::relief>(
        {.field = "ChartTransferRequest::relief",
         .name = "relief",
         .help = "with transfer at texels: bumps of normal maps shadow one another"}),
    Row::number<&BakeRequest::bounces>(
        whole(0, BakeRequest::maxBounces),
        {.field = "BakeRequest::bounces", .name = "bounces", .help = "diffuse bounces in all transfer"}),
    Row::flag<&BakeRequest::specular>(
        {.field = "BakeRequest::specular",
         .name = "specular-transport",
         .help = "all transfer includes light through glass and from mirrors and metal: caustics that turn "
                 "with the sky, and reflections in mirrors; without it such surfaces count as opaque and "
                 "black",
         .argument = "specular"}),
    including<&BakeRequest::glossyBounces, &BakeRequest::specular>(
        {.field = "BakeRequest::glossyBounces",
         .name = "glossy-bounces",
         .help = "specular transport, and also reflections by the rough lobes of all other materials"}),
    Row::flag<&BakeRequest::subsurface>(
        {.field = "BakeRequest::subsurface",
         .name = "subsurface-transport",
         .help = "AO, SH, CH and Haar transfer include light that passes through surfaces diffusely, as "
                 "through leaves, or is scattered within bodies; without it such surfaces do not show this "
                 "light",
         .argument = "subsurface"}),
    Row::number<&BakeRequest::limits, &OcclusionLimits::nearest>(
        real(0, farthest), {.field = "OcclusionLimits::nearest",
                            .name = "near",
                            .help = "surfaces nearer than this occlude nothing, metres",
                            .unit = "m",
                            .argument = "nearest"}),
    Row::number<&BakeRequest::limits, &OcclusionLimits::farthest>(
        real(1e-9, farthest, "no limit"), {.field = "OcclusionLimits::farthest",
                                           .name = "far",
                                           .help = "surfaces farther away than this occlude nothing, metres",
                                           .unit = "m",
                                           .argument = "farthest"}),
    Row::number<&BakeRequest::limits, &OcclusionLimits::obscurance>(
        real(1e-9, farthest, "no fading"),
        {.field = "OcclusionLimits::obscurance",
         .name = "obscurance",
         .help = "occluders fade out linearly with their distance, up to this many metres",
         .unit = "m"}),
    Row::own({.field = "BakeRequest::shadowSets",
              .name = "shadow-set",
              .help = "let only these OCCLUDERS cast shadows on these RECEIVERS, and the receivers on "
                      "themselves only if both sides name them: RECEIVERS:OCCLUDERS, each side a list of "
                      "node names or patterns with commas between; repeat it for more; with nothing after "
                      "the colon the receivers have no shadows",
              .argument = "shadow_sets",
              .example = "Room*,Floor:Sofa*"}),
    Row::number<&BakeRequest::effort, &Effort::rays>(
        whole(1, BakeRequest::maxRays),
        {.field = "Effort::rays", .name = "rays", .help = "rays per vertex, on average"}),
    Row::number<&BakeRequest::effort, &Effort::error>(
        real(1e-6, 1), {.field = "Effort::error",
                        .name = "error",
                        .help = "stop when the estimated standard error of AO is below this everywhere"}),
    Row::number<&BakeRequest::effort, &Effort::seconds>(real(1e-3, 1e7),
                                                        {.field = "Effort::seconds",
                                                         .name = "time",
                                                         .help = "stop after this many seconds of casting",
                                                         .unit = "s",
                                                         .argument = "seconds"}),
    Row::own({.field = "BakeRequest::seed",
              .name = "seed",
              .help = "seed of the random numbers (default 0); the same seed gives the same bytes"}),
    Row::number<&BakeRequest::maxMemory>(
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

}  // namespace

template <>
std::span<const Option<BakeRequest>> optionsOf<BakeRequest>() {
  return bakeRows;
}

template <>
std::span<const Option<AnimationKeys>> optionsOf<AnimationKeys>() {
  return keyRows;
}

}  // namespace prelight
