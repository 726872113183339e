#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/skip/setting.h"
#include "benchmarks/suite_run.h"
#include "prelight/device.h"

namespace prelight::benchmarks {

/// One number that was measured. Times are medians over the runs that follow a warm-up.
struct BenchmarkResult {
  std::string suite;
  std::string case_;  ///< what was measured on, from the general to the particular: "shapes/random order/any"
  std::string metric;           ///< "throughput", "total", ...
  double value = 0.0;           ///< finite, in `unit`
  std::string unit;             ///< "rays/s", "s", "AO"
  std::string peer;             ///< what `ratio` compares with, measured in the same run; empty: nothing
  std::optional<double> ratio;  ///< > 1: better than the peer
};

/// How much is measured. The defaults are for numbers worth keeping.
struct BenchmarkOptions {
  int runs = 5;                                                 ///< >= 1, after one that warms up
  std::uint64_t castRays = 1u << 20;                            ///< of each measured cast
  std::uint64_t rayCount = 1u << 19;                            ///< of each case of `rays`
  int rayRounds = 24;                                           ///< short ones, in which peers take turns
  std::vector<std::uint64_t> rayTriangles = {250000, 2000000};  ///< of the scenes of `rays` and `build`
  std::vector<std::uint64_t> scalingTriangles = {1000, 10000, 100000, 1000000, 10000000};  ///< ascending
  std::uint64_t bakeRays = 256;                                                            ///< a vertex
  std::vector<std::uint64_t> errorRays = {64, 128, 256, 512, 1024};  ///< a vertex, ascending
  std::uint64_t errorReferenceRays = 4096;                           ///< a vertex
  int referenceSize = 64;  ///< pixels, of the square pictures of `reference`
  std::vector<std::uint64_t> referenceSamples = {2, 8, 32, 128};  ///< a pixel, ascending
  std::uint64_t referenceLongRun = 2048;                          ///< a pixel
  int waveletFaceSize = 64;                                       ///< texels, a power of two from 4 to 512
  int waveletReceivers = 300;
  int waveletFrames = 61;                                             ///< of a degree each
  std::vector<std::size_t> waveletCounts = {10, 30, 100, 300, 1000};  ///< of the light's coefficients
  std::vector<std::filesystem::path> skies = {};  ///< .hdr or .exr, that `wavelets` uses beside its own
                                                  ///< lights, the first of which `techniques` shows
  std::uint64_t relightVertices = 100000;         ///< of `relight`
  int relightSkyRows = 512;                       ///< of the sky of `relight`
  int relightRounds = 40;                         ///< short ones, in which kernels and copies take turns
  std::vector<int> basisOrders = {2, 3, 4, 5, 6, 7, 8, 9, 10};
  std::size_t basisDirections = 1u << 18;                   ///< of each way, a multiple of 64
  int basisRounds = 25;                                     ///< short ones, in which ways take turns
  std::vector<int> animationKeys = {2, 3, 5, 9, 17};        ///< evenly spaced, of `animation`
  std::vector<double> animationErrors = {0.1, 0.05, 0.03};  ///< that keys are chosen by
  int animationMoments = 8;                                 ///< between keys, that are compared
  int compressOrder = 6;                                    ///< of the transfer of `compress`
  int compressBounces = 2;
  std::vector<std::string> compressMethods = {
      "half",       "band8",      "rgbe",       "pca:4",          "pca:8",      "pca:16",    "pca:24",
      "vq:64",      "vq:256",     "vq:1024",    "cpca:16:4",      "cpca:16:8",  "cpca:64:4", "cpca:64:8",
      "cpca:64:16", "cpca:256:4", "cpca:256:8", "cpca:64:8:byte", "pca:16:byte"};
  std::vector<std::string> voScenes = {"shapes", "swing", "bumps", "caustics", "cornell", "rooms"};
  std::uint64_t voRays = 1024;       ///< a vertex, where `vo` measures errors
  std::size_t voLights = 16;         ///< around a scene, and as many inside
  std::size_t voPoints = 10000;      ///< of the surface, at which shadows are traced
  std::uint64_t voCostRays = 10000;  ///< a vertex, where `vo` measures the time of a bake
  int voCostRounds = 3;
  int voShadingRounds = 7;
  std::uint64_t voShadingVertices = 100000;
  std::vector<std::size_t> voLightCounts = {1, 2, 4, 8, 16, 32};  ///< that vertices are shaded by
  std::vector<std::string> rasterisedScenes = {"shapes", "cornell", "rooms"};  ///< built in, or files
  std::size_t rasterisedReceivers = 400;
  int rasterisedOrder = 3;
  std::uint32_t rasterisedTruthRays = 1u << 14;
  std::vector<int> rasterisedSides = {16, 32, 64};  ///< texels of a picture
  std::vector<std::string> radiosityScenes = {"cornell", "rooms"};
  std::uint32_t radiosityRays = 512;  ///< an element, a power of two
  double radiosityTolerance = 1e-5;   ///< that each solver is timed to; its curve goes on to a tenth of it
  int radiositySeeds = 8;             ///< over which errors of form factors are averaged
  std::vector<std::string> lightMapScenes = {"cornell", "rooms", "shapes"};
  std::uint64_t lightMapRays = 1024;  ///< a texel
  std::uint64_t lightMapPhotons = 1u << 18;
  std::vector<std::uint32_t> lightMapTexels = {1u << 12, 1u << 14, 1u << 16, 1u << 18};  ///< of one size
  std::vector<double> lightMapErrors = {0.1, 0.05, 0.02};  ///< that sizes of texels are chosen by
  std::size_t lightMapPlaces = 20000;                      ///< of the surface, at which maps are compared
  std::uint64_t lightMapTruthRays = 4096;                  ///< a place, twice
  std::vector<std::string> gatherScenes = {"cornell", "rooms", "caustics"};  ///< built in, or files
  std::uint32_t gatherTexels = 4096;
  std::vector<std::uint32_t> gatherRays = {16, 32, 64, 128, 256, 512};  ///< a texel or record, powers of two
  std::uint32_t gatherLongRun = 2048;                                   ///< by which biases are told, twice
  int gatherTruthRuns = 4;  ///< of each of two truths at most, of twice as many rays
  std::vector<std::string> encodingScenes = {"cornell", "rooms", "shapes", "bumps"};
  std::size_t encodingPlaces = 24;                                     ///< of each scene
  int encodingSide = 32;                                               ///< pixels of a place's pictures
  std::uint64_t encodingSamples = 128;                                 ///< a pixel
  std::vector<std::uint64_t> photonCounts = {10000, 100000, 1000000};  ///< ascending, of trees against grids
  std::uint64_t photonCount = 1000000;                                 ///< of maps as the thesis'
  std::uint64_t photonLookups = 1u << 15;
  int causticSide = 256;  ///< pixels, of the picture of a caustic
  std::vector<std::uint64_t> causticPhotons = {10000, 50000, 200000, 1000000};
  std::vector<int> causticNearest = {10, 20, 50, 100};
  std::vector<double> causticRadii = {1.0, 2.0, 4.0};  ///< pixels
  int photonPasses = 1024;
  int photonsPerPass = 1000;
  std::vector<int> updateCells = {1, 36, 115};  ///< a side of the moving room's walls
  int updateFrames = 64;                        ///< in which its objects move
  int updateSide = 512;                         ///< pixels of what is drawn
  std::uint64_t updatePhotons = 20000;          ///< of the scenes below
  /// Built-in scenes and the node of each that is moved once.
  std::vector<std::pair<std::string, std::string>> updateScenes = {
      {"cornell", "Short box"}, {"rooms", "Right crate"}, {"shapes", "Cone"}, {"caustics", "Glass sphere"}};
  std::vector<std::string> liveLightRows = {"rooms",
                                            "shapes"};  ///< built in, or files, of which rows are made
  int liveLightCopies = 8;                              ///< in a row
  int liveLightHeight = 90;                             ///< pixels of the picture in which light is compared
  std::uint32_t liveLightRays = 256;                    ///< a texel
  std::uint32_t liveLightTexels = 8192;
  std::uint64_t liveLightTruth = 1000000;  ///< photons
  std::vector<std::uint64_t> liveLightPhotons = {8000, 32000};
  std::vector<std::string> techniqueScenes = {
      "shapes",  "shiny shapes",        "crowd", "crowd under a sky", "crowd with an object put in",
      "cornell", "rooms by area lights"};
  std::uint64_t techniqueRays = 10000;      ///< a vertex, of the scenes that are as the thesis'
  std::uint64_t techniqueCrowdRays = 1024;  ///< of the others, at most
  int techniqueOrder = 6;                   ///< largest of SH and CH
  int techniqueHaarSize = 32;               ///< texels of a face's side
  int techniqueWidth = 240;                 ///< pixels
  int techniqueHeight = 135;
  std::uint64_t techniqueSamples = 1u << 16;  ///< a pixel of the truth at most
  int techniqueFrames = 9;                    ///< of each technique, whose times' median counts
  int techniqueObjects = 25;                  ///< of the crowd
  int techniqueLights = 20;
  std::vector<std::string> nearLampScenes = {"cornell", "rooms"};
  int nearLampOrder = 6, nearLampShells = 8;
  std::uint64_t nearLampRays = 1024;
  int nearLampWidth = 256, nearLampHeight = 192;              ///< pixels
  int nearLampSamples = 64;                                   ///< of area lights, of the truth
  std::vector<std::string> objectModels = {"ring", "plate"};  ///< that `objects` moves: made by it, or files
  std::uint64_t objectRays = 512;                             ///< a vertex
  int objectMoves = 9;                                        ///< timed
  std::uint64_t objectSamples = 512;                          ///< a pixel of the truth, twice
  int objectWidth = 240, objectHeight = 135;                  ///< pixels
  std::vector<std::uint64_t> materialRays = {64, 256, 1024};  ///< a vertex or texel, ascending
  std::vector<int> materialOrders = {3, 4, 5, 6};             ///< of SH, ascending
  std::vector<std::uint64_t> materialSamples = {4, 16, 64};   ///< a pixel, of path tracing
  std::uint64_t materialTruthSamples = 512;                   ///< a pixel, twice
  int materialWidth = 160, materialHeight = 120;              ///< pixels
  std::vector<std::string> screenScenes = {"shapes", "rooms", "cornell"};  ///< built in, or files
  int screenWidth = 320;                                                   ///< pixels
  int screenHeight = 180;
  int screenRays = 512;  ///< a pixel of the truth
  int screenFrames = 5;  ///< of each technique, of whose times the least counts
  std::vector<std::string> viewerScenes = {"shapes", "cornell", "rooms", "swing", "caustics"};
  std::vector<std::pair<int, int>> viewerSizes = {{640, 360}, {1280, 720}};  ///< pixels
  int viewerFrames = 30;                                                     ///< of each movement, at most
  int viewerInputs = 3;            ///< of each kind, whose latency is measured, at most
  int viewerOrder = 4;             ///< of SH
  std::uint64_t viewerRays = 256;  ///< a vertex
  int techniqueSkyRows = 256;      ///< of the sky where none is given
  std::vector<int> stabilityOrders = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32};  ///< of bases, ascending
  std::vector<int> stabilityFaceSizes = {4, 8, 16, 32, 64, 128};          ///< of cube maps, powers of two
  std::vector<int> stabilitySkyRows = {16, 64, 256, 1024};
  std::vector<int> stabilityElementCells = {4, 12, 32};  ///< a side; elements are twice the square
  std::size_t stabilityRays = 2000;                      ///< of a kind, against every triangle
  std::size_t stabilityLights = 1000000;                 ///< at most, of one scene
  std::uint64_t stabilityPhotons = 1000000000;           ///< among which those of `stability` are numbered
  std::uint64_t stabilityFlownPhotons = 1u << 16;        ///< that it flies through each room
  std::vector<std::size_t> stabilityDensityPhotons = {2000, 20000, 200000};  ///< of a square, ascending
  std::uint64_t stabilityBakeRays = 64;                                      ///< a vertex
  std::vector<std::string> stabilityScenes = {"shapes", "caustics", "cornell"};
  skip::Effort skipEffort = {};       ///< of what `skip` bakes and draws
  std::filesystem::path folder = {};  ///< where suites write more than charts; empty: nowhere
  std::filesystem::path truths = {};  ///< where `techniques` keeps its truths; empty: nowhere

  std::vector<std::uint64_t> bakeScalingTriangles = {10000,   100000,  407000,
                                                     1390000, 4690000, 10000000};  ///< ascending
  std::vector<std::uint64_t> bakeScalingRays = {16, 64, 256, 1024, 4096};          ///< a vertex, ascending
  std::uint64_t bakeScalingMostRays = 180000000;   ///< of a bake, unless of 64 a vertex
  std::uint64_t bakeScalingTracedRays = 1u << 22;  ///< that are enough to time tracing alone
  std::uint64_t bakeScalingLongBake = 1u << 23;    ///< rays from which on a bake runs once
  std::vector<std::uint64_t> bakeScalingPeerTriangles = {407000, 1390000};  ///< of which errors are compared
  std::vector<std::uint32_t> bakeScalingPeerSides = {2, 4, 8, 16, 32};      ///< of squares of rays, ascending
  std::uint64_t bakeScalingPeerRays = 180000000;                            ///< of the peer at most
  std::size_t bakeScalingPlaces = 4096;                                     ///< of the surface, of an error
  std::uint32_t bakeScalingTruthSide = 32;  ///< of a square of paths a place, twice
  std::string onlyCase = {};    ///< cases whose names contain it, of `bake-scaling`, `compress`, `skip`,
                                ///< `stability` and `viewer`; empty: all
  double suiteSeconds = 540.0;  ///< that `viewer`, `gather` and `techniques` take each, about
  std::filesystem::path program = {};  ///< `prelight`, which `bake-scaling` runs

  /// So little that every suite ends within seconds: shows that the benchmarks work, not how fast anything
  /// is.
  static BenchmarkOptions quick();

  nlohmann::ordered_json toJson() const;
};

struct BenchmarkSuite {
  std::string name;
  std::string description;
};

const std::vector<BenchmarkSuite>& suites();

/// Whether a suite has a case that BenchmarkOptions::onlyCase chooses: where it is empty, every suite has.
bool hasChosenCase(const std::string& suite, const BenchmarkOptions& options);

/// Measures one suite on a device; `run` has the results. Throws UsageError for a name that suites() does not
/// list, Interrupted when `run` is asked to stop, and what the library throws.
void runSuite(const std::string& name, const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// {suite, case, metric, value, unit, peer, ratio}; peer and ratio are null where there is none.
nlohmann::ordered_json toJson(const BenchmarkResult& result);

}  // namespace prelight::benchmarks
