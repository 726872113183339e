#include "benchmarks/suite.h"

#include <algorithm>

#include "base/error.h"
#include "benchmarks/ray_peer.h"
#include "benchmarks/suites.h"

namespace prelight::benchmarks {

namespace {

struct Entry {
  BenchmarkSuite suite;
  std::vector<BenchmarkResult> (*run)(const Device&, const BenchmarkOptions&, Progress&);
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> list = {
      {{"cast", "rays a second in bake order and in random order, wide tree against narrow"}, runCastSuite},
      {{"rays", "rays a second of bakes, photons and cameras through many triangles, against Embree"},
       runRaysSuite},
      {{"trees", "seconds, bytes and steps a ray of the trees of each build quality"}, runTreesSuite},
      {{"build", "seconds and bytes of the tree over many triangles, against Embree"}, runBuildSuite},
      {{"scaling", "rays a second and the tree, from a thousand triangles to ten million, against Embree"},
       runScalingSuite},
      {{"bake", "seconds of each stage of a bake of AO, of AO and SH, and of both with a bounce"},
       runBakeSuite},
      {{"error", "error of AO against time, and the error that a bake reports against the measured one"},
       runErrorSuite},
      {{"reference", "error of the reference renderer against time, and the error that it reports"},
       runReferenceSuite},
      {{"full", "error of pictures with all light against time, beside path tracing"}, runFullSuite},
      {{"wavelets", "error and flicker of Haar wavelets by the number of the light's coefficients"},
       runWaveletsSuite},
      {{"relight", "bytes a second of relighting and light projection on the device, against copying"},
       runRelightSuite},
      {{"animation", "error of transfer between baked moments of an animation"}, runAnimationSuite},
      {{"compress", "error and bytes of transfer in each compressed form"}, runCompressSuite},
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
       runStabilitySuite},
#ifdef PRELIGHT_WITH_VIEWER
      {{"techniques", "seconds, bytes, frames and errors of every technique, against path-traced pictures"},
       runTechniquesSuite},
#endif
  };
  return list;
}

}  // namespace

BenchmarkOptions BenchmarkOptions::quick() {
  return {.runs = 1,
          .castRays = 1u << 14,
          .rayCount = 1u << 14,
          .rayRounds = 3,
          .rayTriangles = {2000},
          .scalingTriangles = {1000, 2000},
          .bakeRays = 16,
          .errorRays = {16, 32},
          .errorReferenceRays = 64,
          .referenceSize = 16,
          .referenceSamples = {2, 4},
          .referenceLongRun = 16,
          .waveletFaceSize = 8,
          .waveletReceivers = 12,
          .waveletFrames = 3,
          .waveletCounts = {5, 20},
          .relightVertices = 200,
          .relightSkyRows = 16,
          .relightRounds = 3,
          .animationKeys = {2, 3},
          .animationErrors = {0.3},
          .animationMoments = 2,
          .compressOrder = 2,
          .compressBounces = 0,
          .compressMethods = {"half", "band8", "pca:2", "vq:8", "cpca:4:2"},
          .voScenes = {"shapes"},
          .voRays = 16,
          .voLights = 2,
          .voPoints = 100,
          .voCostRays = 16,
          .voCostRounds = 1,
          .voShadingRounds = 1,
          .voShadingVertices = 600,
          .voLightCounts = {1, 2, 3},
          .radiosityScenes = {"cornell"},
          .radiosityRays = 64,
          .radiosityTolerance = 0.03,
          .radiositySeeds = 1,
          .lightMapScenes = {"cornell"},
          .lightMapRays = 16,
          .lightMapPhotons = 1000,
          .lightMapTexels = {256, 1024},
          .lightMapErrors = {0.5, 0.3},
          .lightMapPlaces = 200,
          .lightMapTruthRays = 16,
          .encodingScenes = {"cornell"},
          .encodingPlaces = 2,
          .encodingSide = 4,
          .encodingSamples = 4,
          .photonCounts = {2000},
          .photonCount = 2000,
          .photonLookups = 500,
          .causticSide = 32,
          .causticPhotons = {2000},
          .causticNearest = {10},
          .causticRadii = {2.0},
          .photonPasses = 4,
          .photonsPerPass = 500,
          .updateCells = {1, 4},
          .updateFrames = 16,
          .updateSide = 32,
          .updatePhotons = 500,
          .updateScenes = {{"cornell", "Short box"}},
          .techniqueScenes = {"shapes", "crowd under a sky"},
          .techniqueRays = 8,
          .techniqueOrder = 3,
          .techniqueHaarSize = 4,
          .techniqueWidth = 32,
          .techniqueHeight = 18,
          .techniqueSamples = 4,
          .techniqueFrames = 1,
          .techniqueObjects = 2,
          .techniqueLights = 2,
          .techniqueSkyRows = 16,
          .stabilityOrders = {1, 3, 8},
          .stabilityFaceSizes = {4, 16},
          .stabilitySkyRows = {16, 64},
          .stabilityElementCells = {4, 8},
          .stabilityRays = 200,
          .stabilityLights = 10000,
          .stabilityFlownPhotons = 2000,
          .stabilityDensityPhotons = {2000},
          .stabilityBakeRays = 16,
          .stabilityScenes = {"caustics"}};
}

nlohmann::ordered_json BenchmarkOptions::toJson() const {
  std::vector<std::string> skyNames;
  for (const std::filesystem::path& sky : skies) skyNames.push_back(sky.filename().string());
  return {{"runs", runs},
          {"castRays", castRays},
          {"rayCount", rayCount},
          {"rayRounds", rayRounds},
          {"rayTriangles", rayTriangles},
          {"scalingTriangles", scalingTriangles},
          {"rayPeer", embreeVersion().empty() ? "none" : embreeVersion()},
          {"bakeRays", bakeRays},
          {"errorRays", errorRays},
          {"errorReferenceRays", errorReferenceRays},
          {"referenceSize", referenceSize},
          {"referenceSamples", referenceSamples},
          {"referenceLongRun", referenceLongRun},
          {"radiosityScenes", radiosityScenes},
          {"radiosityRays", radiosityRays},
          {"radiosityTolerance", radiosityTolerance},
          {"radiositySeeds", radiositySeeds},
          {"waveletFaceSize", waveletFaceSize},
          {"waveletReceivers", waveletReceivers},
          {"waveletFrames", waveletFrames},
          {"waveletCounts", waveletCounts},
          {"skies", skyNames},
          {"relightVertices", relightVertices},
          {"relightSkyRows", relightSkyRows},
          {"relightRounds", relightRounds},
          {"animationKeys", animationKeys},
          {"animationErrors", animationErrors},
          {"animationMoments", animationMoments},
          {"compressOrder", compressOrder},
          {"compressBounces", compressBounces},
          {"compressMethods", compressMethods},
          {"voScenes", voScenes},
          {"voRays", voRays},
          {"voLights", voLights},
          {"voPoints", voPoints},
          {"voCostRays", voCostRays},
          {"voCostRounds", voCostRounds},
          {"voShadingRounds", voShadingRounds},
          {"voShadingVertices", voShadingVertices},
          {"voLightCounts", voLightCounts},
          {"lightMapScenes", lightMapScenes},
          {"lightMapRays", lightMapRays},
          {"lightMapPhotons", lightMapPhotons},
          {"lightMapTexels", lightMapTexels},
          {"lightMapErrors", lightMapErrors},
          {"lightMapPlaces", lightMapPlaces},
          {"lightMapTruthRays", lightMapTruthRays},
          {"encodingScenes", encodingScenes},
          {"encodingPlaces", encodingPlaces},
          {"encodingSide", encodingSide},
          {"encodingSamples", encodingSamples},
          {"photonCounts", photonCounts},
          {"photonCount", photonCount},
          {"photonLookups", photonLookups},
          {"causticSide", causticSide},
          {"causticPhotons", causticPhotons},
          {"causticNearest", causticNearest},
          {"causticRadii", causticRadii},
          {"photonPasses", photonPasses},
          {"photonsPerPass", photonsPerPass},
          {"updateCells", updateCells},
          {"updateFrames", updateFrames},
          {"updateSide", updateSide},
          {"updatePhotons", updatePhotons},
          {"updateScenes", updateScenes},
          {"techniqueScenes", techniqueScenes},
          {"techniqueRays", techniqueRays},
          {"techniqueCrowdRays", techniqueCrowdRays},
          {"techniqueOrder", techniqueOrder},
          {"techniqueHaarSize", techniqueHaarSize},
          {"techniqueWidth", techniqueWidth},
          {"techniqueHeight", techniqueHeight},
          {"techniqueSamples", techniqueSamples},
          {"techniqueFrames", techniqueFrames},
          {"techniqueObjects", techniqueObjects},
          {"techniqueLights", techniqueLights},
          {"techniqueSkyRows", techniqueSkyRows},
          {"stabilityOrders", stabilityOrders},
          {"stabilityFaceSizes", stabilityFaceSizes},
          {"stabilitySkyRows", stabilitySkyRows},
          {"stabilityElementCells", stabilityElementCells},
          {"stabilityRays", stabilityRays},
          {"stabilityLights", stabilityLights},
          {"stabilityPhotons", stabilityPhotons},
          {"stabilityFlownPhotons", stabilityFlownPhotons},
          {"stabilityDensityPhotons", stabilityDensityPhotons},
          {"stabilityBakeRays", stabilityBakeRays},
          {"stabilityScenes", stabilityScenes}};
}

const std::vector<BenchmarkSuite>& suites() {
  static const std::vector<BenchmarkSuite> list = [] {
    std::vector<BenchmarkSuite> all;
    for (const Entry& entry : entries()) all.push_back(entry.suite);
    return all;
  }();
  return list;
}

std::vector<BenchmarkResult> runSuite(const std::string& name, const Device& device,
                                      const BenchmarkOptions& options, Progress& progress) {
  std::string known;
  for (const Entry& entry : entries()) {
    if (entry.suite.name == name) return entry.run(device, options, progress);
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
