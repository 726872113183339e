#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "prelight/error.h"
#include "prelight/light_map.h"
#include "prelight/plan.h"
#include "prelight/request.h"
#include "prelight/scene.h"
#include "prelight/transfer.h"

namespace prelight {

class Device;
class Progress;
struct LoadedScene;

/// The sky that baked light was baked under, where the scene's file does not hold it.
struct BakedSky {
  std::string name;        ///< built-in: its name; else the path of its file, as seen from the baked one
  double rotation = 0.0;   ///< radians, counter-clockwise about +Y seen from above
  std::uint64_t hash = 0;  ///< skyHash() of it
};

/// How a bake was made; written to the file's root.
struct BakeInfo {
  std::string generator;
  std::uint64_t seed = 0;
  std::uint64_t rays = 0;  ///< rays cast in all
  double error = 0.0;      ///< estimated standard error of AO, RMS over the surface
  int bounces = 0;
  Plan plan;
  std::string device;
  double seconds = 0.0;
  std::optional<SceneMoment> moment = {};  ///< that the scene was posed at; none: at rest
  std::string variant = {};                ///< of its materials; empty: the file's own
  int scene = -1;                          ///< of several in the file, the one that was baked; -1: it had one
  OcclusionLimits limits = {};             ///< of what is baked from hemispheres
  std::vector<ShadowSetRequest> shadowSets = {};  ///< likewise
  std::optional<BakedSky> sky = {};               ///< none: there was none, or that of the scene's file
};

/// Baked values of every vertex of a CompiledScene, in its vertex order. A technique that was not asked for
/// is empty.
struct Bake {
  std::vector<float> ao;               ///< [vertex], cosine-weighted accessibility in [0,1], 1 = open
  std::vector<glm::vec3> bentNormals;  ///< [vertex], unit
  std::vector<float> apertures;  ///< [vertex], cosine of half the angle of the cone about the bent normal
                                 ///< that lets through what `ao` says, 0..1
  std::optional<HorizonTransfer> horizons;
  std::optional<HarmonicTransfer> sh;
  std::optional<CompressedTransfer> compressedSh;  ///< in place of `sh`
  std::optional<HarmonicTransfer> ch;
  std::optional<NearLampTransfer> nearLamps;  ///< what shadows lamps within the scene
  std::optional<AnimatedTransfer> animation;  ///< SH at moments; `sh` is that of the rest pose
  std::optional<HaarTransfer> haar;
  std::optional<ThroughTransfer> through;  ///< of the above, what arrives on the other side of surfaces
  std::optional<GlossyTransfer> glossy;
  std::optional<LightGroupTransfer> lightGroups;
  std::optional<OccluderTransfer> occluders;
  std::optional<VolumeTransfer> volume;              ///< of points in the air
  std::optional<ChartTransfer> chartTransfer;        ///< at the texels of charts
  CompressedParts compressedParts;                   ///< of `animation`, `volume` and `chartTransfer`
  std::optional<LightMap> lightMap;                  ///< of the scene's own lights
  std::optional<std::vector<glm::vec3>> irradiance;  ///< [vertex], W/m2 of the scene's static lights
  std::vector<EncodedLight> encodedLight;            ///< of vertices, the fronts
  BakeInfo info;
};

/// A solution on its way: norms after that much work.
struct ResidualPoint {
  double sweeps = 0.0;    ///< row operations so far over the number of rows
  double seconds = 0.0;   ///< since the start
  double residual = 0.0;  ///< sum of area x |residual| of the strongest channel over that of the direct light
};

struct SolveReport {
  std::vector<ResidualPoint> curve;
  bool converged = false;
  double sweeps() const { return curve.empty() ? 0.0 : curve.back().sweeps; }
  double residual() const { return curve.empty() ? 0.0 : curve.back().residual; }
};

/// What a solution cost and how far it went.
struct RadiosityReport {
  std::uint64_t elements = 0;  ///< that were cast from
  std::uint64_t entries = 0;   ///< of the form-factor rows
  std::uint64_t castRays = 0;
  std::uint64_t directRays = 0;  ///< of all lights so far
  double castSeconds = 0.0;
  double rowSeconds = 0.0;  ///< from counts to form factors
  double directSeconds = 0.0;
  double solveSeconds = 0.0;
  double patchSize = 0.0;
  RadiosityMethod method = RadiosityMethod::GaussSeidel;
  SolveReport solve;  ///< of the last lights
};

/// What people are told of texel sizes.
struct TexelSizeReport {
  double smallest = 0.0;      ///< m
  double largest = 0.0;       ///< m
  double error = 0.0;         ///< as expected, rms over the area of the charts that were judged
  std::uint32_t specks = 0;   ///< see TexelSizes
  std::uint32_t limited = 0;  ///< see TexelSizes
};

/// What baking a light map took.
struct LightMapReport {
  std::uint64_t rays = 0;
  std::optional<TexelSizeReport> sizes;  ///< where they were chosen by error
  std::size_t hidden = 0;                ///< texels inside objects
  double jumpBefore = 0.0;               ///< seamJump() before stitching, W/m2
  double jumpAfter = 0.0;
  double error = 0.0;  ///< of light that is shown, rms, in shares of its mean: noise and what lies between
                       ///< texels, found at `places`; what photons tell is taken as it is
  std::size_t places = 0;
  std::string replaced;  ///< whose TEXCOORD_1 is not used for charts, and why; empty: none's
};

/// What a bake did, for reports and for people.
struct BakeReport {
  std::vector<std::pair<std::string, double>> stageSeconds;  ///< in the order they ran
  std::uint64_t rays = 0;                                    ///< in all
  std::uint64_t receivers = 0;
  double aoErrorRms = 0.0;          ///< estimated standard error of AO, RMS over the surface
  double aoErrorMax = 0.0;          ///< the same at the worst vertex
  double skippedRayFraction = 0.0;  ///< rays that the request allowed and the scene did not need
  std::uint64_t bytesBvh = 0;
  std::optional<RadiosityReport> radiosity;  ///< where the bake solved one
  std::optional<LightMapReport> lightMap;    ///< where the bake made one
  std::vector<std::string> notes;
  Warnings warnings = {};  ///< what is likely not what was meant, as light that arrives nowhere
};

/// What a bake works with besides the scene and the request.
struct BakeOptions {
  const Device* device = nullptr;  ///< nullptr: the default one, opened for the call
  Progress* progress = nullptr;    ///< nullptr: nobody is told, nothing interrupts
  /// File in which the state of the bake is kept, at least every half a minute and when it is interrupted,
  /// and from which an interrupted bake of the same scene, request, seed and device goes on. It is gone when
  /// the bake is done. Empty: no state is kept.
  std::filesystem::path checkpoint = {};
  double checkpointInterval = 25.0;  ///< s between two states at most
};

struct BakeResult {
  Bake bake;
  BakeReport report;
};

/// Bakes what is asked for. Values are finite for every vertex. The same scene, request and seed give the
/// same bytes on the same device, however often the bake was interrupted, unless it bakes against time.
/// Throws
///
///   UsageError   a request that makes no sense, a checkpoint of another bake
///   InputError   a scene without triangles, or without texture coordinates or surfaces for what is asked
///   Error        the device fails (RuntimeFailure), none is there (NoDevice), memory ends (OutOfMemory)
///   Interrupted  `progress` asks to stop
BakeResult bake(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options = {});

/// Which passes bake() would run, which it would skip and why, and how much memory they would take.
Plan plan(const LoadedScene& scene, const BakeRequest& request);

}  // namespace prelight
