#include <array>

#include "parameters/rows.h"

namespace prelight {

namespace {

using namespace parameters;

constexpr double farthest = 1e9;                          // largest distance that options accept, m
constexpr double largestCell = 1e6, smallestCell = 1e-6;  // m, for texels and elements

template <auto... path>
constexpr Parameter<BakeRequest> of(const About& about) {
  return row<BakeRequest, path...>(about);
}

constexpr auto bakeRows = std::to_array<Parameter<BakeRequest>>({
    of<&BakeRequest::horizons, &HorizonsRequest::sectors>(
        {"HorizonsRequest::sectors", "horizons",
         whole(BakeRequest::minSectors, BakeRequest::maxSectors, "none"), "",
         "horizon angles in this many sectors of azimuth around the normal (8 is usual), to shadow sky, "
         "lights and reflections"}),
    of<&BakeRequest::sh, &ShRequest::order>(
        {"ShRequest::order", "sh", whole(1, BakeRequest::maxShOrder, "none"), "",
         "spherical-harmonic transfer of this order (order squared coefficients)"}),
    of<&BakeRequest::ch, &ChRequest::order>({"ChRequest::order", "ch",
                                             whole(1, BakeRequest::maxShOrder, "none"), "",
                                             "cpherical-harmonic transfer of this order"}),
    of<&BakeRequest::nearLamps, &NearLampsRequest::shells>(
        {"NearLampsRequest::shells", "near-lamps", whole(2, BakeRequest::maxShells, "none"), "",
         "shadows of lamps within the scene, too, from the rays of ShRequest::order or ChRequest::order, "
         "with this many shells of distance (8 is usual)"}),
    of<&BakeRequest::haar, &HaarRequest::size>(
        {"HaarRequest::size",
         "haar",
         {NumberKind::PowerOfTwo, 1, BakeRequest::maxHaarSize, "none"},
         "",
         "Haar wavelet transfer on cube maps with this many texels along a side of a face, a power of two"}),
    of<&BakeRequest::haar, &HaarRequest::error>({"HaarRequest::error", "haar-error", real(0, 1), "",
                                                 "relative error that is allowed when wavelets are dropped"}),
    of<&BakeRequest::glossy, &GlossyRequest::order>(
        {"GlossyRequest::order", "glossy", whole(1, BakeRequest::maxGlossyOrder, "none"), "",
         "transfer matrices of glossy surfaces, of this order (with its fourth power of entries)"}),
    of<&BakeRequest::occluders, &OccluderRequest::records>(
        {"OccluderRequest::records", "", real(1, 256), "",
         "average records per vertex if parts of nodes are chosen as occluders"}),
    of<&BakeRequest::occluders, &OccluderRequest::leastFormFactor>(
        {"OccluderRequest::leastFormFactor", "vo-min-form-factor", real(0, 1), "",
         "drop occluders of a vertex that hide less of its sky than this"}),
    of<&BakeRequest::volume, &VolumeRequest::size>(
        {"VolumeRequest::size", "volume", whole(1, BakeRequest::maxVolumeSize, "none"), "",
         "SH transfer of points in the air, on a grid of this many voxels along the scene's longest side (32 "
         "is usual)"}),
    of<&BakeRequest::chartTransfer, &ChartTransferRequest::size>(
        {"ChartTransferRequest::size", "texels", whole(1, BakeRequest::maxChartSize, "none"), "",
         "SH transfer at texels, too, with the normals of normal maps: texels along a side of the largest "
         "map"}),
    of<&BakeRequest::radiosity, &RadiosityRequest::patchSize>(
        {"RadiosityRequest::patchSize", "patch-size", real(smallestCell, largestCell, "chosen by the scene"),
         "m",
         "radiosity: longest edge of an element, metres; larger triangles are cut (default: thousands of "
         "elements)"}),
    of<&BakeRequest::radiosity, &RadiosityRequest::tolerance>(
        {"RadiosityRequest::tolerance", "tolerance", real(1e-7, 0.5), "",
         "radiosity: stop solving at this residual, a share of the direct light's power"}),
    of<&BakeRequest::radiosity, &RadiosityRequest::skyRotation>(
        {"RadiosityRequest::skyRotation", "", real(-1e4, 1e4), "rad",
         "turn of the sky, counter-clockwise seen from above"}),
    of<&BakeRequest::lightMap, &LightMapRequest::texelSize>(
        {"LightMapRequest::texelSize", "texel-size", real(smallestCell, largestCell, "chosen by the scene"),
         "m",
         "light map: side of a texel, metres (default: such that there are 65 thousand texels, and up to a "
         "million if the surface has many pieces); with LightMapRequest::error the side of the smallest"}),
    of<&BakeRequest::lightMap, &LightMapRequest::error>(
        {"LightMapRequest::error", "texel-error", real(1e-4, 1, "texels of one size"), "",
         "light map: choose a texel size for each chart, such that the rms error between texels is about "
         "this share of the chart's mean light; the smallest texels are a quarter of the usual size"}),
    of<&BakeRequest::lightMap, &LightMapRequest::photons>(
        {"LightMapRequest::photons", "photons", whole(1, 1e9, "chosen by the texels"), "",
         "light map: photons that leave lights, and as many towards mirrors and glass (default: four per "
         "texel, sixteen with LightMapRequest::denoise)"}),
    of<&BakeRequest::bounces>({"BakeRequest::bounces", "bounces", whole(0, BakeRequest::maxBounces), "",
                               "diffuse bounces in all transfer"}),
    of<&BakeRequest::limits, &OcclusionLimits::nearest>(
        {"OcclusionLimits::nearest", "near", real(0, farthest), "m",
         "surfaces nearer than this occlude nothing, metres"}),
    of<&BakeRequest::limits, &OcclusionLimits::farthest>(
        {"OcclusionLimits::farthest", "far", real(1e-9, farthest, "no limit"), "m",
         "surfaces farther away than this occlude nothing, metres"}),
    of<&BakeRequest::limits, &OcclusionLimits::obscurance>(
        {"OcclusionLimits::obscurance", "obscurance", real(1e-9, farthest, "no fading"), "m",
         "occluders fade out linearly with their distance, up to this many metres"}),
    of<&BakeRequest::effort, &Effort::rays>(
        {"Effort::rays", "rays", whole(1, BakeRequest::maxRays), "", "rays per vertex, on average"}),
    of<&BakeRequest::effort, &Effort::error>(
        {"Effort::error", "error", real(1e-6, 1), "",
         "stop when the estimated standard error of AO is below this everywhere"}),
    of<&BakeRequest::effort, &Effort::seconds>(
        {"Effort::seconds", "time", real(1e-3, 1e7), "s", "stop after this many seconds of casting"}),
    of<&BakeRequest::maxMemory>(
        {"BakeRequest::maxMemory",
         "max-memory",
         {NumberKind::Bytes, 0x1p20, 0x1p50},
         "",
         "memory that the program may use, such as 512M or 8G: stored transport that does not fit is kept in "
         "a temporary file, and a bake that needs more nevertheless is refused (default: about 400 bytes per "
         "triangle and 300 MB; a bake is then refused only if this machine has too little memory)"}),
});

constexpr auto keyRows = std::to_array<Parameter<AnimationKeys>>({
    row<AnimationKeys, &AnimationKeys::count>(
        {"AnimationKeys::count", "keys", whole(1, AnimationKeys::mostKeys), "",
         "moments, evenly spaced from the animation's start to its end"}),
    row<AnimationKeys, &AnimationKeys::error>(
        {"AnimationKeys::error", "key-error", real(1e-6, 1), "",
         "instead of a number: as many as keep the relative error between them below this"}),
});

}  // namespace

template <>
std::span<const Parameter<BakeRequest>> parametersOf<BakeRequest>() {
  return bakeRows;
}

template <>
std::span<const Parameter<AnimationKeys>> parametersOf<AnimationKeys>() {
  return keyRows;
}

}  // namespace prelight
