#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "prelight/error.h"
#include "prelight/hemisphere_renderer.h"
#include "prelight/plan.h"
#include "prelight/scene.h"
#include "prelight/techniques.h"

namespace prelight {

class Device;
class Progress;
struct LoadedScene;

/// The sky that a scene was baked under, if it is not the one in the scene's file.
struct BakedSky {
  std::string name;        ///< name of a built-in sky, or path of a sky's file relative to the baked file
  double rotation = 0.0;   ///< radians, counter-clockwise about +Y seen from above
  std::uint64_t hash = 0;  ///< skyHash() of the sky
};

/// How a bake was made. Files store it at their root.
struct BakeInfo {
  std::string generator;
  std::uint64_t seed = 0;
  std::uint64_t rays = 0;  ///< number of rays cast in total
  double error = 0.0;      ///< estimated standard error of AO, RMS over the surface
  int bounces = 0;
  Plan plan;
  std::string device;
  double seconds = 0.0;
  std::optional<SceneMoment> moment = {};  ///< moment that the scene was posed at; none: at rest
  std::string variant = {};     ///< variant of the scene's materials; empty: the file's own materials
  int scene = -1;               ///< index of the baked scene in a file with several; -1: the file has one
  OcclusionLimits limits = {};  ///< limits on occlusion in techniques that sample hemispheres
  std::vector<ShadowSetRequest> shadowSets = {};  ///< shadow sets of the same techniques
  double refined = 0.0;              ///< RefineRequest::error that the scene was refined with; 0: it was not
  std::string visibility = {};       ///< name of the renderer of receivers' views; empty: rays were traced
  std::optional<BakedSky> sky = {};  ///< none: no sky, or the one in the scene's file
};

/// A bake: baked values of techniques, and how they were made.
struct Bake : TechniqueParts {
  BakeInfo info;
};

/// Progress of an iterative solution: the residual after some work.
struct ResidualPoint {
  double sweeps = 0.0;   ///< row operations so far divided by the number of rows
  double seconds = 0.0;  ///< since the start of the solution
  /// Sum of area x |residual| in the strongest channel, relative to the same sum of the direct light.
  double residual = 0.0;
};

/// Convergence of a solution.
struct SolveReport {
  std::vector<ResidualPoint> curve;
  bool converged = false;
  double sweeps() const { return curve.empty() ? 0.0 : curve.back().sweeps; }
  double residual() const { return curve.empty() ? 0.0 : curve.back().residual; }
};

/// Cost and accuracy of a radiosity solution.
struct RadiosityReport {
  std::uint64_t elements = 0;  ///< elements that rays were cast from
  std::uint64_t entries = 0;   ///< entries of the form-factor matrix
  std::uint64_t castRays = 0;
  std::uint64_t directRays = 0;  ///< shadow rays of all lights so far
  double castSeconds = 0.0;
  double rowSeconds = 0.0;  ///< time to turn ray counts into form factors
  double directSeconds = 0.0;
  double solveSeconds = 0.0;
  double patchSize = 0.0;
  RadiosityMethod method = RadiosityMethod::GaussSeidel;
  SolveReport solve;  ///< solution for the last set of lights
};

/// Texel sizes that were chosen by error.
struct TexelSizeReport {
  double smallest = 0.0;      ///< m
  double largest = 0.0;       ///< m
  double error = 0.0;         ///< expected relative error, RMS over the area of the charts that were judged
  std::uint32_t specks = 0;   ///< see TexelSizes
  std::uint32_t limited = 0;  ///< see TexelSizes
};

/// Statistics of baking a light map.
struct LightMapReport {
  std::uint64_t rays = 0;
  std::optional<TexelSizeReport> sizes;  ///< present if texel sizes were chosen by error
  std::size_t hidden = 0;                ///< texels inside objects
  double jumpBefore = 0.0;               ///< seamJump() before stitching, W/m2
  double jumpAfter = 0.0;
  /// Relative RMS error of the light shown, due to noise and to interpolation between texels, measured at
  /// `places`; light from photons counts as exact.
  double error = 0.0;
  /// Number of places that `error` was measured at.
  std::size_t places = 0;
  /// Message that names the meshes whose TEXCOORD_1 is not used for charts, and why; empty: none.
  std::string replaced;
};

/// Statistics and messages of a bake.
struct BakeReport {
  std::vector<std::pair<std::string, double>> stageSeconds;  ///< in the order in which the stages ran
  std::uint64_t rays = 0;                                    ///< rays cast in total
  std::uint64_t receivers = 0;
  double aoErrorRms = 0.0;          ///< estimated standard error of AO, RMS over the surface
  double aoErrorMax = 0.0;          ///< standard error of AO at the worst vertex
  double skippedRayFraction = 0.0;  ///< share of the requested rays that the scene did not need
  std::uint64_t bytesBvh = 0;
  std::optional<RadiosityReport> radiosity;  ///< present if the bake solved for radiosity
  std::optional<LightMapReport> lightMap;    ///< present if the bake made a light map
  std::vector<std::string> notes;
  Warnings warnings = {};  ///< likely mistakes in the input, such as light that reaches no surface
};

/// Options of bake() besides the scene and the request.
struct BakeOptions {
  const Device* device = nullptr;  ///< nullptr: the default device, opened for the call
  Progress* progress = nullptr;    ///< nullptr: no progress reports, no interruption
  /// File that keeps the state of the bake. It is written when the bake is interrupted and at least every
  /// half a minute, lets an interrupted bake of the same scene, request, seed and device continue, and is
  /// removed when the bake is done. Empty: no state is kept.
  std::filesystem::path checkpoint = {};
  double checkpointInterval = 25.0;          ///< longest time between two states, seconds
  HemisphereRendererMaker hemispheres = {};  ///< required for Visibility::Raster
};

/// Result of bake().
struct BakeResult {
  Bake bake;
  BakeReport report;
};

/// Bakes the requested techniques. Values are finite for every vertex. Equal scene, request and seed give
/// equal bytes on the same device, however often the bake was interrupted, unless the request has a time
/// limit. Throws
///
///
///   UsageError   if the request is contradictory or the checkpoint belongs to another bake
///   InputError   if the scene lacks triangles, or texture coordinates or surfaces that the request needs
///   Error        if the device fails (RuntimeFailure), there is none (NoDevice) or memory ends (OutOfMemory)
///   Interrupted  if `progress` asks to stop
BakeResult bake(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options = {});

/// Returns which passes bake() would run, which it would skip and why, and how much memory they would take.
Plan plan(const LoadedScene& scene, const BakeRequest& request);

}  // namespace prelight
