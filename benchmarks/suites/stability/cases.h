#pragma once

#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "benchmarks/suites/stability/trials.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

/// Scenes whose light is known in closed form, and the functions that subjects() runs, each in a file that the
/// comments below name.
namespace prelight::benchmarks::stability {

using std::numbers::pi;

/// Returns a Lambertian material.
Material matte(double albedo, double emission = 0.0);

/// Returns the square [-half, half]^2 at y = 0, facing +Y, of `cells` x `cells` quads, moved by `offset`.
CompiledScene floorScene(double half, int cells, const Material& material,
                         const glm::dvec3& offset = glm::dvec3(0.0));

struct Sheet {
  double height = 0.0;
  Material material;
  bool facesDown = false;
};

/// Returns squares [-half, half]^2 above one another.
CompiledScene stackScene(double half, const std::vector<Sheet>& sheets);

/// Returns a closed cube of `half` about `offset` that faces inwards, with `cells` x `cells` quads per face.
CompiledScene roomScene(double half, int cells, const Material& material,
                        const glm::dvec3& offset = glm::dvec3(0.0));

/// Returns a closed sphere of 20 x 4^steps triangles that faces inwards.
CompiledScene hollowSphere(double radius, int steps, const Material& material);

Light pointLight(const glm::dvec3& position, double intensity);
Light farLight(const glm::dvec3& direction, double irradiance);

/// Returns a camera at `eye` that looks at `target`.
Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target, double yFov);

/// Returns no images, for functions that take those of a scene.
const std::vector<Image>& noImages();

enum class TexelStress { Random, Even, Sun, Denormal };

/// Returns texels of a cube map, 6 x faceSize^2.
std::vector<float> hardTexels(int faceSize, TexelStress stress);

// Bases on the host (basis_cases.cpp, sh_cases.cpp).
void runHostSh(Trials& trials);
void runCh(Trials& trials);
void runHaar(Trials& trials);
void runQuincunx(Trials& trials);

// Bases and lights on the device (sh_cases.cpp, surface_cases.cpp).
void runShEvaluate(Trials& trials);
void runChEvaluate(Trials& trials);
void runHarmonicSums(Trials& trials);
void runShRotation(Trials& trials);
void runSkyToSh(Trials& trials);
void runSkyToHaar(Trials& trials);
void runSkySampling(Trials& trials);
void runBsdf(Trials& trials);

// Relighting (transfer_cases.cpp, bake_cases.cpp).
void runDense(Trials& trials);
void runKeys(Trials& trials);
void runClusters(Trials& trials);
void runHaarRows(Trials& trials);
void runGlossy(Trials& trials);
void runOccluders(Trials& trials);

// Rays and the use of their hits (ray_cases.cpp, hit_cases.cpp, volume_cases.cpp, specular_cases.cpp).
void runGenerateRays(Trials& trials);
void runTracing(Trials& trials);
void runProjection(Trials& trials);
void runGatherBounce(Trials& trials);
void runTexels(Trials& trials);
void runVolume(Trials& trials);
void runStoreSenders(Trials& trials);
void runSpecular(Trials& trials);
void runWalks(Trials& trials);

// Light that is traced (photon_cases.cpp, room_cases.cpp, light_cases.cpp).
void runPhotons(Trials& trials);
void runDensity(Trials& trials);
void runGather(Trials& trials);
void runSolver(Trials& trials);
void runRadiosity(Trials& trials);
void runDirectLight(Trials& trials);
void runPaths(Trials& trials);
void runPictures(Trials& trials);

// Numbers that are stored (storage_cases.cpp).
void runStorage(Trials& trials);
void runAverages(Trials& trials);
void runTallies(Trials& trials);
void runPacked(Trials& trials);
void runCopies(Trials& trials);
void runFit(Trials& trials);

// Inputs that the host refuses (storage_cases.cpp).
void runRefusals(Trials& trials);

// Whole bakes (bake_cases.cpp).
void runBakes(Trials& trials);
void runWholeScenes(Trials& trials);

}  // namespace prelight::benchmarks::stability
