#pragma once

#include "benchmarks/suite.h"

/// The suites behind runSuite(): one file a suite.
namespace prelight::benchmarks {

/// Rays a second through the tree of each built-in scene, in bake order and at random, against the other
/// tree.
std::vector<BenchmarkResult> runCastSuite(const Device& device, const BenchmarkOptions& options,
                                          Progress& progress);

/// Rays a second of several kinds through detailed rooms of growing size, against Embree.
std::vector<BenchmarkResult> runRaysSuite(const Device& device, const BenchmarkOptions& options,
                                          Progress& progress);

/// Seconds and bytes of the trees over detailed rooms, against Embree.
std::vector<BenchmarkResult> runBuildSuite(const Device& device, const BenchmarkOptions& options,
                                           Progress& progress);

/// Seconds, bytes and the steps that rays take, of the tree of each build quality.
std::vector<BenchmarkResult> runTreesSuite(const Device& device, const BenchmarkOptions& options,
                                           Progress& progress);

/// Rays a second, and seconds and bytes of the tree, from a thousand triangles to ten million, against
/// Embree.
std::vector<BenchmarkResult> runScalingSuite(const Device& device, const BenchmarkOptions& options,
                                             Progress& progress);

/// Seconds of each stage of three bakes of each built-in scene, against the plainest of them.
std::vector<BenchmarkResult> runBakeSuite(const Device& device, const BenchmarkOptions& options,
                                          Progress& progress);

/// Seconds of each stage, processor use and memory of whole bakes of growing scenes by processes of their
/// own, against their rays traced alone.
std::vector<BenchmarkResult> runBakeScalingSuite(const Device& device, const BenchmarkOptions& options,
                                                 Progress& progress);

/// Whether BenchmarkOptions::onlyCase leaves it a case; the same below.
bool hasBakeScalingCase(const BenchmarkOptions& options);

/// Error and time of AO for growing numbers of rays, and the error that the bake itself reports.
std::vector<BenchmarkResult> runErrorSuite(const Device& device, const BenchmarkOptions& options,
                                           Progress& progress);

/// Error and time of the reference renderer for growing numbers of samples, and the error that it reports.
std::vector<BenchmarkResult> runReferenceSuite(const Device& device, const BenchmarkOptions& options,
                                               Progress& progress);

/// Error and time of pictures with all light, by samples a pixel, against path tracing to the same error.
std::vector<BenchmarkResult> runGlobalIlluminationSuite(const Device& device, const BenchmarkOptions& options,
                                                        Progress& progress);

/// Error against time of indirect light at texels by each GatherChoice, and its bias in a long run.
std::vector<BenchmarkResult> runGatherSuite(const Device& device, const BenchmarkOptions& options,
                                            Progress& progress);

/// Error, flicker and row sizes of Haar wavelets, by how the light's coefficients are chosen and turned; the
/// quincunx lattice beside them.
std::vector<BenchmarkResult> runWaveletsSuite(const Device& device, const BenchmarkOptions& options,
                                              Progress& progress);

/// Bytes a second of relighting and of projecting lights on the device, against copying, and their errors.
std::vector<BenchmarkResult> runRelightSuite(const Device& device, const BenchmarkOptions& options,
                                             Progress& progress);

/// Error of transfer between the keys of an animation, by their number and how it is interpolated.
std::vector<BenchmarkResult> runAnimationSuite(const Device& device, const BenchmarkOptions& options,
                                               Progress& progress);

/// Error and bytes of each compression of baked transfer.
std::vector<BenchmarkResult> runCompressSuite(const Device& device, const BenchmarkOptions& options,
                                              Progress& progress);

/// Error of the shadows of vector occluders, by formula and records, against traced ones; what they add to a
/// bake, and what shading costs by lights.
std::vector<BenchmarkResult> runVoSuite(const Device& device, const BenchmarkOptions& options,
                                        Progress& progress);

/// Errors of form factors by rays, beside hemicubes; sweeps, seconds and residuals of each way to solve the
/// radiosity equation; seconds of new lights against new form factors.
std::vector<BenchmarkResult> runRadiositySuite(const Device& device, const BenchmarkOptions& options,
                                               Progress& progress);

/// What light maps are off by, how many texels and bytes they have and how long they take, by the size of
/// their texels and by the error that sizes are chosen by.
std::vector<BenchmarkResult> runLightMapsSuite(const Device& device, const BenchmarkOptions& options,
                                               Progress& progress);

/// Bytes, error and time of ways to store incident light, against the light itself at places of scenes.
std::vector<BenchmarkResult> runEncodingsSuite(const Device& device, const BenchmarkOptions& options,
                                               Progress& progress);

/// Seconds to sort photons into maps and to look irradiance up, of trees against grids and beside the numbers
/// of Larsen's thesis (2004, Tables 8.1, 8.2, 14.1); error against the number of photons.
std::vector<BenchmarkResult> runPhotonsSuite(const Device& device, const BenchmarkOptions& options,
                                             Progress& progress);

/// Seconds of frames in which indirect light and caustics follow moving objects, stage by stage and beside
/// Larsen's thesis (2004, ch. 14); what an object's move touches, what is done again, and how far it stays
/// from computing all again.
std::vector<BenchmarkResult> runUpdateSuite(const Device& device, const BenchmarkOptions& options,
                                            Progress& progress);

/// Errors of every kernel and every basis on inputs that are hard on them, against double precision and
/// closed forms, and the bounds that they are to keep. Writes its tables into options.folder.
std::vector<BenchmarkResult> runStabilitySuite(const Device& device, const BenchmarkOptions& options,
                                               Progress& progress);

/// Rays, launches, bytes and processor time of bakes and pictures with each feature absent, present but not
/// needed, and needed, and whether the first two give the same bits. Writes its table into options.folder.
std::vector<BenchmarkResult> runSkipSuite(const Device& device, const BenchmarkOptions& options,
                                          Progress& progress);
bool hasSkipCase(const BenchmarkOptions& options);

/// Every technique's seconds and bytes, its frames a second, and what its pictures differ by from path-traced
/// ones, beside the numbers of Sherif's thesis (2013, Table 7.1). Writes tables and pictures into
/// options.folder. Needs OpenGL.
std::vector<BenchmarkResult> runTechniquesSuite(const Device& device, const BenchmarkOptions& options,
                                                Progress& progress);

/// Error of screen-space occlusion against traced accessibility, and what its frames take, by technique.
/// Writes its pictures into options.folder. Needs OpenGL.
std::vector<BenchmarkResult> runScreenSuite(const Device& device, const BenchmarkOptions& options,
                                            Progress& progress);

/// Error of the direct light of point and area lights within scenes, with shadows by shells of distance and
/// without, against shadow rays; what shells change about far lights and cost in rays. Needs OpenGL.
std::vector<BenchmarkResult> runNearLampsSuite(const Device& device, const BenchmarkOptions& options,
                                               Progress& progress);

/// Milliseconds of the frames of a window, drawn without a display, by the clock, of all processors and of
/// OpenGL's own timer, of every shading on every scene at every size, while the camera, a light, the sky or a
/// node moves and when nothing does; latency from such an input to the picture; bytes that frames upload.
/// Needs OpenGL.
std::vector<BenchmarkResult> runViewerSuite(const Device& device, const BenchmarkOptions& options,
                                            Progress& progress);
bool hasViewerCase(const BenchmarkOptions& options);

/// Errors and processor time of SH of visibility and of gathers by each rasterised map, beside rays.
std::vector<BenchmarkResult> runRasterisedSuite(const Device& device, const BenchmarkOptions& options,
                                                Progress& progress);

}  // namespace prelight::benchmarks
