#include <prelight/prelight.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "plane.h"

namespace {

int failures = 0;

void expect(bool holds, const std::string& what) {
  if (holds) return;
  std::cerr << "consumer: " << what << "\n";
  ++failures;
}

void expectNear(double got, double expected, double relative, const std::string& what) {
  expect(std::abs(got - expected) <= relative * std::abs(expected),
         what + ": got " + std::to_string(got) + ", expected " + std::to_string(expected));
}

/// Nothing hides the sky from a plane, so its accessibility is 1. Its normal is +Y: transfer is 1/pi times
/// the integral of y Y_i over the upper hemisphere, which is 0.282095 for the constant function, (2/3)
/// 0.488603 for y, and 0 for the two others.
void bakePlane(const prelight::LoadedScene& scene, const prelight::Device& device) {
  const auto [bake, report] = prelight::bake(scene, {.ao = true, .sh = {.order = 2}}, {.device = &device});
  expect(bake.ao.size() == 4, "accessibility of four vertices");
  for (const float ao : bake.ao) expectNear(ao, 1.0, 1e-3, "accessibility of a plane");
  expect(bake.sh && bake.sh->coefficients.size() == 16, "four coefficients at four vertices");
  for (std::size_t v = 0; bake.sh && v < 4; ++v) {
    const float* row = bake.sh->coefficients.data() + 4 * v;
    expectNear(row[0], 0.282095, 2e-3, "transfer of a plane, constant");
    expectNear(row[1], 0.325735, 2e-3, "transfer of a plane, along its normal");
    expect(std::abs(row[2]) < 2e-3 && std::abs(row[3]) < 2e-3, "transfer of a plane, across its normal");
  }
  expect(report.rays > 0, "rays of a bake are counted");
}

void tracePlane(const prelight::LoadedScene& scene, const prelight::Device& device) {
  const std::vector<prelight::Ray> rays = {{{0.5, 2.0, -0.25}, {0.0, -3.0, 0.0}},
                                           {{0.5, 2.0, -0.25}, {0.0, 1.0, 0.0}}};
  const auto hits = prelight::trace(scene, rays, {.device = &device});
  expect(hits.size() == 2 && hits[0] && !hits[1], "one ray hits the plane, one the sky");
  if (!hits[0]) return;
  expectNear(hits[0]->distance, 2.0, 1e-6, "distance of the plane");
  expect(glm::length(hits[0]->normal - glm::dvec3(0, 1, 0)) < 1e-6, "normal of the plane");
  expect(glm::length(hits[0]->position - glm::dvec3(0.5, 0, -0.25)) < 1e-5, "place on the plane");
  expect(scene.compiled.primitives.at(hits[0]->primitive).node == 0, "node of the plane");
}

/// From the light, the plane has a solid angle of 4 atan(a^2 / (h sqrt(2 a^2 + h^2))) with a = 10 m and h = 1
/// m. Every photon that lands does so once, as nothing reflects it back.
void sendPhotons(const prelight::LoadedScene& scene, const prelight::Device& device) {
  const prelight::PhotonResult sent = prelight::photons(scene, {.photons = 100'000, .device = &device});
  const double pi = std::numbers::pi, solidAngle = 4.0 * std::atan(100.0 / std::sqrt(201.0));
  expectNear(sent.emitted.x, 4.0 * pi * 10.0, 1e-4, "power of a point light");
  expectNear(sent.absorbed.x + sent.escaped.x, sent.emitted.x, 1e-4, "power that is kept");
  double power = 0.0;
  for (const prelight::LandedPhoton& photon : sent.photons) {
    power += photon.power.x;
    expect(std::abs(photon.position.y) < 1e-5, "photons lie on the plane");
  }
  expectNear(power, 10.0 * solidAngle, 0.01, "power that lands");
}

/// Under a sky of radiance 1 a plane that reflects half of the light has radiance 0.5 everywhere.
void renderPlane(const prelight::LoadedScene& scene, const prelight::Device& device) {
  const prelight::Environment sky = prelight::constantEnvironment(glm::vec3(1.0f));
  prelight::Camera camera;
  camera.world = glm::dmat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 2, 0, 1);  // Looks down from 2 m above.
  const prelight::Picture picture = prelight::render(scene, {.width = 32,
                                                             .height = 24,
                                                             .samples = 64,
                                                             .camera = camera,
                                                             .lights = std::vector<prelight::Light>(),
                                                             .sky = &sky,
                                                             .device = &device});
  expect(picture.width == 32 && picture.height == 24 && picture.pixels.size() == 32 * 24,
         "size of a picture");
  double mean = 0.0;
  for (const glm::vec3& pixel : picture.pixels) mean += pixel.y / static_cast<double>(picture.pixels.size());
  expectNear(mean, 0.5, 0.01, "radiance of a plane under an even sky");
  prelight::writePicture("consumer.exr", picture);  // Uses the module of picture formats beside the library.
  expect(prelight::readPicture("consumer.exr").pixels == picture.pixels, "a picture reads as it was written");
  std::filesystem::remove("consumer.exr");
}

void bakeBuiltin(const prelight::Device& device) {
  const prelight::LoadedScene scene = prelight::loadBuiltin("cornell");
  const prelight::BakeRequest request{.ao = true, .sh = {.order = 3}, .bounces = 1, .effort = {.rays = 256}};
  const auto [bake, report] = prelight::bake(scene, request, {.device = &device});
  expect(bake.ao.size() == scene.compiled.vertexCount(), "accessibility of every vertex");
  for (const float ao : bake.ao) expect(ao >= 0.0f && ao <= 1.0f, "accessibility lies between 0 and 1");
  expect(bake.sh && bake.sh->channels == 3, "bounces are coloured");
  prelight::save("consumer.glb", scene, bake);
  const prelight::LoadedScene again = prelight::load("consumer.glb");
  const std::optional<prelight::Bake> read = prelight::carriedBake(again);
  expect(read && read->ao == bake.ao && read->sh && read->sh->coefficients == bake.sh->coefficients,
         "a bake reads as it was written");
  std::filesystem::remove("consumer.glb");
  const prelight::Picture picture =
      prelight::render(again, {.method = prelight::RenderMethod::GlobalIllumination,
                               .width = 32,
                               .height = 32,
                               .samples = 4,
                               .device = &device});
  double brightest = 0.0;
  for (const glm::vec3& pixel : picture.pixels) brightest = std::max<double>(brightest, pixel.x);
  expect(brightest > 0.0, "a lit room is not dark");
}

}  // namespace

int main() {
  try {
    const prelight::Device device = prelight::Device::open({});
    const prelight::LoadedScene scene = plane();
    expect(scene.warnings.empty() && scene.compiled.triangleCount() == 2, "a plane of two triangles");
    bakePlane(scene, device);
    tracePlane(scene, device);
    sendPhotons(scene, device);
    renderPlane(scene, device);
    bakeBuiltin(device);
  } catch (const std::exception& error) {
    expect(false, error.what());
  }
  std::cout << (failures == 0 ? "all as expected\n" : "");
  return failures == 0 ? 0 : 1;
}
