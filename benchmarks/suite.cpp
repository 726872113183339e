#include "benchmarks/suite.h"

#include <algorithm>

#include "benchmarks/ray_peer.h"
#include "benchmarks/suites.h"
#include "prelight/error.h"

namespace prelight::benchmarks {

namespace {

struct Entry {
  BenchmarkSuite suite;
  void (*run)(const Device&, const BenchmarkOptions&, SuiteRun&);
  bool (*hasChosenCase)(const BenchmarkOptions&) = nullptr;  ///< null: its cases are not chosen from
};

/// That need OpenGL.
std::vector<Entry> drawnEntries() {
#ifdef PRELIGHT_WITH_VIEWER
  return {
      {{"techniques", "seconds, bytes, frames and errors of every technique, against path-traced pictures"},
       runTechniquesSuite},
      {{"rasterised",
        "errors and time of SH and gathers that OpenGL draws, by map and resolution, beside rays"},
       runRasterisedSuite},
      {{"screen", "error of screen-space occlusion against traced accessibility, and time of its frames"},
       runScreenSuite},
      {{"near-lamps", "error of shadows of lamps within scenes by shells of distance, against shadow rays"},
       runNearLampsSuite},
      {{"live-light", "light that follows what moves: lamps thinned by distance, in pictures"},
       runLiveLightSuite},
      {{"objects",
        "error and time of the shadows of objects that move among baked scenes, by how they are found"},
       runObjectsSuite},
      {{"materials", "error against time of bodies that scatter light, measured materials and reliefs"},
       runMaterialsSuite},
      {{"viewer", "frame times, latency and uploads of the window, by shading, scene, size and movement"},
       runViewerSuite,
       hasViewerCase},
  };
#else
  return {};
#endif
}

std::vector<Entry> tracedEntries() {
  return {
      {{"cast", "rays a second in bake order and in random order, wide tree against narrow"}, runCastSuite},
      {{"rays", "rays a second of bakes, photons and cameras through many triangles, against Embree"},
       runRaysSuite},
      {{"trees", "seconds, bytes and steps a ray of the trees of each build quality"}, runTreesSuite},
      {{"build", "seconds and bytes of the tree over many triangles, against Embree"}, runBuildSuite},
      {{"scaling", "rays a second and the tree, from a thousand triangles to ten million, against Embree"},
       runScalingSuite},
      {{"bake", "seconds of each stage of a bake of AO, of AO and SH, and of both with a bounce"},
       runBakeSuite},
      {{"bake-scaling", "seconds, memory and share of tracing of whole bakes, from 10 k triangles to 10 M"},
       runBakeScalingSuite,
       hasBakeScalingCase},
      {{"error", "error of AO against time, and the error that a bake reports against the measured one"},
       runErrorSuite},
      {{"reference", "error of the reference renderer against time, and the error that it reports"},
       runReferenceSuite},
      {{"full", "error of pictures with all light against time, beside path tracing"},
       runGlobalIlluminationSuite},
      {{"gather", "error of indirect light against time, and its bias, by how its texels are gathered"},
       runGatherSuite},
      {{"wavelets", "error and flicker of Haar wavelets by the number of the light's coefficients"},
       runWaveletsSuite},
      {{"relight", "bytes a second of relighting and light projection on the device, against copying"},
       runRelightSuite},
      {{"basis", "time, operations and error of evaluating SH and CH on the device, by order"},
       runBasisSuite},
      {{"animation", "error of transfer between baked moments of an animation"}, runAnimationSuite},
      {{"compress", "error and bytes of transfer in each compressed form"},
       runCompressSuite,
       hasCompressCase},
      {{"vo",
        "error of the shadows of vector occluders against traced ones, cost of baking and shading them"},
       runVoSuite},
      {{"radiosity", "errors of form factors, residuals of the solvers, seconds of new lights"},
       runRadiositySuite},
      {{"lightmaps", "error, texels, bytes and seconds of light maps by the size of texels and by error"},
       runLightMapsSuite},
      {{"encodings", "bytes, error and time of ways to store incident light for bumped normals"},
       runEncodingsSuite},
      {{"photons",
        "seconds to sort photons and to look irradiance up, trees against grids; error against work"},
       runPhotonsSuite},
      {{"update", "seconds of frames in which light follows moving objects, and what they do again"},
       runUpdateSuite},
      {{"stability", "errors of every kernel and basis on inputs that are hard on them, against bounds"},
       runStabilitySuite,
       hasStabilityCase},
      {{"skip", "rays, launches, bytes and seconds of features that are absent, present in vain, and needed"},
       runSkipSuite,
       hasSkipCase},
  };
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> list = [] {
    std::vector<Entry> all = tracedEntries();
    const std::vector<Entry> drawn = drawnEntries();
    all.insert(all.end(), drawn.begin(), drawn.end());
    return all;
  }();
  return list;
}

/// Of rays, bakes, pictures and transfer.
void quickenTransfer(BenchmarkOptions& options) {
  options.runs = 1;
  options.castRays = 1u << 14;
  options.rayCount = 1u << 14;
  options.rayRounds = 3;
  options.rayTriangles = {2000};
  options.scalingTriangles = {1000, 2000};
  options.bakeScalingTriangles = {10000, 100000};
  options.bakeScalingRays = {16};
  options.bakeScalingTracedRays = 1u << 18;
  options.bakeScalingLongBake = 0;
  options.bakeScalingPeerTriangles = {10000};
  options.bakeScalingPeerSides = {2, 4};
  options.bakeScalingPlaces = 64;
  options.bakeScalingTruthSide = 4;
  options.bakeRays = 16;
  options.errorRays = {16, 32};
  options.errorReferenceRays = 64;
  options.referenceSize = 16;
  options.referenceSamples = {2, 4};
  options.referenceLongRun = 16;
  options.waveletFaceSize = 8;
  options.waveletReceivers = 12;
  options.waveletFrames = 3;
  options.waveletCounts = {5, 20};
  options.relightVertices = 200;
  options.relightSkyRows = 16;
  options.relightRounds = 3;
  options.basisOrders = {2, 3};
  options.basisDirections = 1u << 12;
  options.basisRounds = 3;
  options.animationKeys = {2, 3};
  options.animationErrors = {0.3};
  options.animationMoments = 2;
  options.compressOrder = 2;
  options.compressBounces = 0;
  options.compressMethods = {"half", "band8", "pca:2", "vq:8", "cpca:4:2"};
  options.voScenes = {"shapes"};
  options.voRays = 16;
  options.voLights = 2;
  options.voPoints = 100;
  options.voCostRays = 16;
  options.voCostRounds = 1;
  options.voShadingRounds = 1;
  options.voShadingVertices = 600;
  options.voLightCounts = {1, 2, 3};
}

/// Of radiosity, light maps, encodings and photons.
void quickenLight(BenchmarkOptions& options) {
  options.encodingScenes = {"cornell"};
  options.encodingPlaces = 2;
  options.encodingSide = 4;
  options.encodingSamples = 4;
  options.rasterisedScenes = {"shapes"};
  options.rasterisedReceivers = 16;
  options.rasterisedTruthRays = 256;
  options.rasterisedSides = {16};
  options.radiosityScenes = {"cornell"};
  options.radiosityRays = 64;
  options.radiosityTolerance = 0.03;
  options.radiositySeeds = 1;
  options.lightMapScenes = {"cornell"};
  options.lightMapRays = 16;
  options.lightMapPhotons = 1000;
  options.lightMapTexels = {256, 1024};
  options.lightMapErrors = {0.5, 0.3};
  options.lightMapPlaces = 200;
  options.lightMapTruthRays = 16;
  options.gatherScenes = {"cornell"};
  options.gatherTexels = 200;
  options.gatherRays = {8, 16};
  options.gatherLongRun = 32;
  options.gatherTruthRuns = 1;
  options.photonCounts = {2000};
  options.photonCount = 2000;
  options.photonLookups = 500;
  options.causticSide = 32;
  options.causticPhotons = {2000};
  options.causticNearest = {10};
  options.causticRadii = {2.0};
  options.photonPasses = 4;
  options.photonsPerPass = 500;
  options.updateCells = {1, 4};
  options.updateFrames = 16;
  options.updateSide = 32;
  options.updatePhotons = 500;
  options.updateScenes = {{"cornell", "Short box"}};
  options.liveLightRows = {"rooms"};
  options.liveLightCopies = 2;
  options.liveLightHeight = 9;
  options.liveLightRays = 16;
  options.liveLightTexels = 200;
  options.liveLightTruth = 4000;
  options.liveLightPhotons = {1000};
}

/// Of whole techniques, the viewer and stability.
void quickenTechnique(BenchmarkOptions& options) {
  options.techniqueScenes = {"shapes", "crowd under a sky", "cornell"};
  options.techniqueRays = 8;
  options.techniqueOrder = 3;
  options.techniqueHaarSize = 4;
  options.techniqueWidth = 32;
  options.techniqueHeight = 18;
  options.techniqueSamples = 4;
  options.techniqueFrames = 1;
  options.techniqueObjects = 2;
  options.techniqueLights = 2;
  options.techniqueSkyRows = 16;
  options.nearLampScenes = {"cornell"};
  options.nearLampOrder = 3;
  options.nearLampShells = 2;
  options.nearLampRays = 16;
  options.nearLampWidth = 32;
  options.nearLampHeight = 24;
  options.nearLampSamples = 4;
  options.objectModels = {"ring"};
  options.objectRays = 16;
  options.objectMoves = 1;
  options.objectSamples = 4;
  options.objectWidth = 32;
  options.objectHeight = 18;
  options.materialRays = {16};
  options.materialOrders = {2};
  options.materialSamples = {2};
  options.materialTruthSamples = 4;
  options.materialWidth = 32;
  options.materialHeight = 24;
  options.screenScenes = {"shapes"};
  options.screenWidth = 32;
  options.screenHeight = 18;
  options.screenRays = 16;
  options.screenFrames = 1;
  options.suiteSeconds = 60.0;
  options.viewerScenes = {"shapes"};
  options.viewerSizes = {{32, 18}, {64, 36}};
  options.viewerFrames = 3;
  options.viewerInputs = 1;
  options.viewerOrder = 2;
  options.viewerRays = 8;
  options.stabilityOrders = {1, 3, 8};
  options.stabilityFaceSizes = {4, 16};
  options.stabilitySkyRows = {16, 64};
  options.stabilityElementCells = {4, 8};
  options.stabilityRays = 200;
  options.stabilityLights = 10000;
  options.stabilityFlownPhotons = 2000;
  options.stabilityDensityPhotons = {2000};
  options.stabilityBakeRays = 16;
  options.stabilityScenes = {"caustics"};
  options.skipEffort = {
      .rays = 4, .photons = 200, .texelSize = 0.5, .patchSize = 1.0, .side = 8, .samples = 1};
}

/// Of rays, bakes, pictures and transfer.
nlohmann::ordered_json transferJson(const BenchmarkOptions& options) {
  std::vector<std::string> skies;
  for (const std::filesystem::path& sky : options.skies) skies.push_back(sky.filename().string());
  return {{"runs", options.runs},
          {"castRays", options.castRays},
          {"rayCount", options.rayCount},
          {"rayRounds", options.rayRounds},
          {"rayTriangles", options.rayTriangles},
          {"scalingTriangles", options.scalingTriangles},
          {"rayPeer", embreeVersion().empty() ? "none" : embreeVersion()},
          {"bakeScalingTriangles", options.bakeScalingTriangles},
          {"bakeScalingRays", options.bakeScalingRays},
          {"bakeScalingMostRays", options.bakeScalingMostRays},
          {"bakeScalingTracedRays", options.bakeScalingTracedRays},
          {"bakeScalingLongBake", options.bakeScalingLongBake},
          {"bakeScalingPeerTriangles", options.bakeScalingPeerTriangles},
          {"bakeScalingPeerSides", options.bakeScalingPeerSides},
          {"bakeScalingPeerRays", options.bakeScalingPeerRays},
          {"bakeScalingPlaces", options.bakeScalingPlaces},
          {"bakeScalingTruthSide", options.bakeScalingTruthSide},
          {"onlyCase", options.onlyCase},
          {"suiteSeconds", options.suiteSeconds},
          {"bakeRays", options.bakeRays},
          {"errorRays", options.errorRays},
          {"errorReferenceRays", options.errorReferenceRays},
          {"referenceSize", options.referenceSize},
          {"referenceSamples", options.referenceSamples},
          {"referenceLongRun", options.referenceLongRun},
          {"waveletFaceSize", options.waveletFaceSize},
          {"waveletReceivers", options.waveletReceivers},
          {"waveletFrames", options.waveletFrames},
          {"waveletCounts", options.waveletCounts},
          {"skies", skies},
          {"relightVertices", options.relightVertices},
          {"relightSkyRows", options.relightSkyRows},
          {"relightRounds", options.relightRounds},
          {"basisOrders", options.basisOrders},
          {"basisDirections", options.basisDirections},
          {"basisRounds", options.basisRounds},
          {"animationKeys", options.animationKeys},
          {"animationErrors", options.animationErrors},
          {"animationMoments", options.animationMoments},
          {"compressOrder", options.compressOrder},
          {"compressBounces", options.compressBounces},
          {"compressMethods", options.compressMethods},
          {"voScenes", options.voScenes},
          {"voRays", options.voRays},
          {"voLights", options.voLights},
          {"voPoints", options.voPoints},
          {"voCostRays", options.voCostRays},
          {"voCostRounds", options.voCostRounds},
          {"voShadingRounds", options.voShadingRounds},
          {"voShadingVertices", options.voShadingVertices},
          {"voLightCounts", options.voLightCounts}};
}

/// Of radiosity, light maps, encodings and photons.
nlohmann::ordered_json lightJson(const BenchmarkOptions& options) {
  return {{"rasterisedScenes", options.rasterisedScenes},
          {"rasterisedReceivers", options.rasterisedReceivers},
          {"rasterisedOrder", options.rasterisedOrder},
          {"rasterisedTruthRays", options.rasterisedTruthRays},
          {"rasterisedSides", options.rasterisedSides},
          {"radiosityScenes", options.radiosityScenes},
          {"radiosityRays", options.radiosityRays},
          {"radiosityTolerance", options.radiosityTolerance},
          {"radiositySeeds", options.radiositySeeds},
          {"encodingScenes", options.encodingScenes},
          {"encodingPlaces", options.encodingPlaces},
          {"encodingSide", options.encodingSide},
          {"encodingSamples", options.encodingSamples},
          {"lightMapScenes", options.lightMapScenes},
          {"lightMapRays", options.lightMapRays},
          {"lightMapPhotons", options.lightMapPhotons},
          {"lightMapTexels", options.lightMapTexels},
          {"lightMapErrors", options.lightMapErrors},
          {"lightMapPlaces", options.lightMapPlaces},
          {"lightMapTruthRays", options.lightMapTruthRays},
          {"gatherScenes", options.gatherScenes},
          {"gatherTexels", options.gatherTexels},
          {"gatherRays", options.gatherRays},
          {"gatherLongRun", options.gatherLongRun},
          {"gatherTruthRuns", options.gatherTruthRuns},
          {"photonCounts", options.photonCounts},
          {"photonCount", options.photonCount},
          {"photonLookups", options.photonLookups},
          {"causticSide", options.causticSide},
          {"causticPhotons", options.causticPhotons},
          {"causticNearest", options.causticNearest},
          {"causticRadii", options.causticRadii},
          {"photonPasses", options.photonPasses},
          {"photonsPerPass", options.photonsPerPass},
          {"updateCells", options.updateCells},
          {"updateFrames", options.updateFrames},
          {"updateSide", options.updateSide},
          {"updatePhotons", options.updatePhotons},
          {"updateScenes", options.updateScenes},
          {"liveLightRows", options.liveLightRows},
          {"liveLightCopies", options.liveLightCopies},
          {"liveLightHeight", options.liveLightHeight},
          {"liveLightRays", options.liveLightRays},
          {"liveLightTexels", options.liveLightTexels},
          {"liveLightTruth", options.liveLightTruth},
          {"liveLightPhotons", options.liveLightPhotons}};
}

/// Of whole techniques, the viewer and stability.
nlohmann::ordered_json techniqueJson(const BenchmarkOptions& options) {
  return {{"techniqueScenes", options.techniqueScenes},
          {"techniqueRays", options.techniqueRays},
          {"techniqueCrowdRays", options.techniqueCrowdRays},
          {"techniqueOrder", options.techniqueOrder},
          {"techniqueHaarSize", options.techniqueHaarSize},
          {"techniqueWidth", options.techniqueWidth},
          {"techniqueHeight", options.techniqueHeight},
          {"techniqueSamples", options.techniqueSamples},
          {"techniqueFrames", options.techniqueFrames},
          {"techniqueObjects", options.techniqueObjects},
          {"techniqueLights", options.techniqueLights},
          {"techniqueSkyRows", options.techniqueSkyRows},
          {"nearLampScenes", options.nearLampScenes},
          {"nearLampOrder", options.nearLampOrder},
          {"nearLampShells", options.nearLampShells},
          {"nearLampRays", options.nearLampRays},
          {"nearLampWidth", options.nearLampWidth},
          {"nearLampHeight", options.nearLampHeight},
          {"nearLampSamples", options.nearLampSamples},
          {"objectModels", options.objectModels},
          {"objectRays", options.objectRays},
          {"objectMoves", options.objectMoves},
          {"objectSamples", options.objectSamples},
          {"objectWidth", options.objectWidth},
          {"objectHeight", options.objectHeight},
          {"materialRays", options.materialRays},
          {"materialOrders", options.materialOrders},
          {"materialSamples", options.materialSamples},
          {"materialTruthSamples", options.materialTruthSamples},
          {"materialWidth", options.materialWidth},
          {"materialHeight", options.materialHeight},
          {"screenScenes", options.screenScenes},
          {"screenWidth", options.screenWidth},
          {"screenHeight", options.screenHeight},
          {"screenRays", options.screenRays},
          {"screenFrames", options.screenFrames},
          {"viewerScenes", options.viewerScenes},
          {"viewerSizes", options.viewerSizes},
          {"viewerFrames", options.viewerFrames},
          {"viewerInputs", options.viewerInputs},
          {"viewerOrder", options.viewerOrder},
          {"viewerRays", options.viewerRays},
          {"stabilityOrders", options.stabilityOrders},
          {"stabilityFaceSizes", options.stabilityFaceSizes},
          {"stabilitySkyRows", options.stabilitySkyRows},
          {"stabilityElementCells", options.stabilityElementCells},
          {"stabilityRays", options.stabilityRays},
          {"stabilityLights", options.stabilityLights},
          {"stabilityPhotons", options.stabilityPhotons},
          {"stabilityFlownPhotons", options.stabilityFlownPhotons},
          {"stabilityDensityPhotons", options.stabilityDensityPhotons},
          {"stabilityBakeRays", options.stabilityBakeRays},
          {"stabilityScenes", options.stabilityScenes},
          {"skipRays", options.skipEffort.rays},
          {"skipPhotons", options.skipEffort.photons},
          {"skipTexelSize", options.skipEffort.texelSize},
          {"skipPatchSize", options.skipEffort.patchSize},
          {"skipSide", options.skipEffort.side},
          {"skipSamples", options.skipEffort.samples}};
}

}  // namespace

BenchmarkOptions BenchmarkOptions::quick() {
  BenchmarkOptions options;
  quickenTransfer(options);
  quickenLight(options);
  quickenTechnique(options);
  return options;
}

nlohmann::ordered_json BenchmarkOptions::toJson() const {
  nlohmann::ordered_json json = transferJson(*this);
  json.update(lightJson(*this));
  json.update(techniqueJson(*this));
  return json;
}

const std::vector<BenchmarkSuite>& suites() {
  static const std::vector<BenchmarkSuite> list = [] {
    std::vector<BenchmarkSuite> all;
    for (const Entry& entry : entries()) all.push_back(entry.suite);
    return all;
  }();
  return list;
}

bool hasChosenCase(const std::string& suite, const BenchmarkOptions& options) {
  if (options.onlyCase.empty()) return true;
  const auto found = std::find_if(entries().begin(), entries().end(),
                                  [&](const Entry& entry) { return entry.suite.name == suite; });
  return found != entries().end() && found->hasChosenCase != nullptr && found->hasChosenCase(options);
}

void runSuite(const std::string& name, const Device& device, const BenchmarkOptions& options, SuiteRun& run) {
  std::string known;
  for (const Entry& entry : entries()) {
    if (entry.suite.name == name) return entry.run(device, options, run);
    known += (known.empty() ? "" : ", ") + entry.suite.name;
  }
  throw UsageError("SUITE", "got '" + name + "', expected one of " + known);
}

nlohmann::ordered_json toJson(const BenchmarkResult& result) {
  nlohmann::ordered_json json = {{"suite", result.suite}, {"case", result.case_}, {"metric", result.metric},
                                 {"value", result.value}, {"unit", result.unit},  {"peer", nullptr},
                                 {"ratio", nullptr}};
  if (!result.peer.empty()) json["peer"] = result.peer;
  if (result.ratio) json["ratio"] = *result.ratio;
  return json;
}

}  // namespace prelight::benchmarks
