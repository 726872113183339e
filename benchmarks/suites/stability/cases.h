#pragma once

#include <vector>

#include "benchmarks/suites/stability/trials.h"

/// Functions that subjects() runs, each in the file of its name or of its neighbours.
namespace prelight::benchmarks::stability {

enum class TexelStress { Random, Even, Sun, Denormal };

/// Texels of a cube map, 6 x faceSize^2.
std::vector<float> hardTexels(int faceSize, TexelStress stress);

// Bases on the host: basis_cases.cpp, sh_cases.cpp.
void runHostSh(Trials& trials);
void runCh(Trials& trials);
void runHaar(Trials& trials);
void runQuincunx(Trials& trials);

// Bases and lights on the device: sh_cases.cpp, sky_cases.cpp, surface_cases.cpp.
void runShEvaluate(Trials& trials);
void runChEvaluate(Trials& trials);
void runHarmonicSums(Trials& trials);
void runShRotation(Trials& trials);
void runSkyToSh(Trials& trials);
void runSkyToHaar(Trials& trials);
void runSkySampling(Trials& trials);
void runBsdf(Trials& trials);

// Relighting: transfer_cases.cpp, occluder_cases.cpp.
void runDense(Trials& trials);
void runKeys(Trials& trials);
void runClusters(Trials& trials);
void runHaarRows(Trials& trials);
void runGlossy(Trials& trials);
void runOccluders(Trials& trials);

// Rays and what becomes of their hits: ray_cases.cpp, hit_cases.cpp, volume_cases.cpp, specular_cases.cpp,
// walk_cases.cpp.
void runGenerateRays(Trials& trials);
void runTracing(Trials& trials);
void runProjection(Trials& trials);
void runGatherBounce(Trials& trials);
void runTexels(Trials& trials);
void runVolume(Trials& trials);
void runStoreSenders(Trials& trials);
void runSpecular(Trials& trials);
void runWalks(Trials& trials);

// Light that is followed: photon_cases.cpp, room_cases.cpp, light_cases.cpp.
void runPhotons(Trials& trials);
void runDensity(Trials& trials);
void runGather(Trials& trials);
void runSolver(Trials& trials);
void runRadiosity(Trials& trials);
void runDirectLight(Trials& trials);
void runPaths(Trials& trials);
void runPictures(Trials& trials);

// Numbers that are kept: storage_cases.cpp.
void runStorage(Trials& trials);
void runAverages(Trials& trials);
void runTallies(Trials& trials);
void runPacked(Trials& trials);
void runCopies(Trials& trials);
void runFit(Trials& trials);

// Inputs that the host refuses: refusal_cases.cpp.
void runRefusals(Trials& trials);

// Whole bakes: bake_cases.cpp.
void runBakes(Trials& trials);
void runWholeScenes(Trials& trials);

}  // namespace prelight::benchmarks::stability
