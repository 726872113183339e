#pragma once

#include "benchmarks/suite.h"
#include "benchmarks/suite_run.h"

/// The suites behind runSuite(): one file a suite. Each adds to the results of its run.
namespace prelight::benchmarks {

/// Rays a second through the tree of each built-in scene, in bake order and at random, against the other
/// tree.
void runCastSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Rays a second of several kinds through detailed rooms of growing size, against Embree.
void runRaysSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Seconds and bytes of the trees over detailed rooms, against Embree.
void runBuildSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Seconds, bytes and the steps that rays take, of the tree of each build quality.
void runTreesSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Rays a second, and seconds and bytes of the tree, from a thousand triangles to ten million, against
/// Embree.
void runScalingSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Seconds of each stage of three bakes of each built-in scene, against the plainest of them.
void runBakeSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Seconds of each stage, processor use and memory of whole bakes of growing scenes by processes of their
/// own, against their rays traced alone.
void runBakeScalingSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Whether BenchmarkOptions::onlyCase leaves it a case; the same below.
bool hasBakeScalingCase(const BenchmarkOptions& options);

/// Error and time of AO for growing numbers of rays, and the error that the bake itself reports.
void runErrorSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Error and time of the reference renderer for growing numbers of samples, and the error that it reports.
void runReferenceSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Error and time of pictures with all light, by samples a pixel, against path tracing to the same error.
void runGlobalIlluminationSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Error against time of indirect light at texels by each GatherChoice, and its bias in a long run.
void runGatherSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Error, flicker and row sizes of Haar wavelets, by how the light's coefficients are chosen and turned; the
/// quincunx lattice beside them.
void runWaveletsSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Bytes a second of relighting and of projecting lights on the device, against copying, and their errors.
void runRelightSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Error of transfer between the keys of an animation, by their number and how it is interpolated.
void runAnimationSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Error and bytes of each compression of baked transfer.
void runCompressSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);
bool hasCompressCase(const BenchmarkOptions& options);

/// Error of the shadows of vector occluders, by formula and records, against traced ones; what they add to a
/// bake, and what shading costs by lights.
void runVoSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Errors of form factors by rays, beside hemicubes; sweeps, seconds and residuals of each way to solve the
/// radiosity equation; seconds of new lights against new form factors.
void runRadiositySuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// What light maps are off by, how many texels and bytes they have and how long they take, by the size of
/// their texels and by the error that sizes are chosen by.
void runLightMapsSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Bytes, error and time of ways to store incident light, against the light itself at places of scenes.
void runEncodingsSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Seconds to sort photons into maps and to look irradiance up, of trees against grids and beside the numbers
/// of Larsen's thesis (2004, Tables 8.1, 8.2, 14.1); error against the number of photons.
void runPhotonsSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Seconds of frames in which indirect light and caustics follow moving objects, stage by stage and beside
/// Larsen's thesis (2004, ch. 14); what an object's move touches, what is done again, and how far it stays
/// from computing all again.
void runUpdateSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Errors of every kernel and every basis on inputs that are hard on them, against double precision and
/// closed forms, and the bounds that they are to keep. Writes its tables into options.folder.
void runStabilitySuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);
bool hasStabilityCase(const BenchmarkOptions& options);

/// Rays, launches, bytes and processor time of bakes and pictures with each feature absent, present but not
/// needed, and needed, and whether the first two give the same bits. Writes its table into options.folder.
void runSkipSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);
bool hasSkipCase(const BenchmarkOptions& options);

/// Time, operations and error of evaluating SH and CH on the device, by order and way.
void runBasisSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Every technique's seconds and bytes, its frames a second, and what its pictures differ by from path-traced
/// ones, beside the numbers of Sherif's thesis (2013, Table 7.1). Writes tables and pictures into
/// options.folder. Needs OpenGL.
void runTechniquesSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Error of screen-space occlusion against traced accessibility, and what its frames take, by technique.
/// Writes its pictures into options.folder. Needs OpenGL.
void runScreenSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Error of the direct light of point and area lights within scenes, with shadows by shells of distance and
/// without, against shadow rays; what shells change about far lights and cost in rays. Needs OpenGL.
void runNearLampsSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Errors of pictures of bodies that scatter light and of measured materials against path-traced ones, and of
/// the light in grooves of a normal texture against marching along its heights, over the time that they take.
/// Needs OpenGL.
void runMaterialsSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// How far pictures are from path-traced ones where objects that were put into scenes shade them, by how
/// their shadows are found, and what each takes when an object moves. Needs OpenGL.
void runObjectsSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// Milliseconds of the frames of a window, drawn without a display, by the clock, of all processors and of
/// OpenGL's own timer, of every shading on every scene at every size, while the camera, a light, the sky or a
/// node moves and when nothing does; latency from such an input to the picture; bytes that frames upload.
/// Needs OpenGL.
void runViewerSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);
bool hasViewerCase(const BenchmarkOptions& options);

/// Errors and processor time of SH of visibility and of gathers by each rasterised map, beside rays.
void runRasterisedSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

/// What is off in pictures of live light, and what a frame costs, by photons: of lamps that are thinned by
/// the viewer's distance, and of lamps that are not.
void runLiveLightSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run);

}  // namespace prelight::benchmarks
