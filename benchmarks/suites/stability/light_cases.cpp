#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/suites/stability/cases.h"
#include "integrators/global_illumination_renderer.h"
#include "integrators/path_tracer.h"
#include "integrators/reference.h"
#include "radiosity/direct_light.h"

// Direct light at points, and pictures, with known closed forms.
namespace prelight::benchmarks::stability {

namespace {

device::Receiver lookingUp(const glm::vec3& position, std::uint32_t seed) {
  return {{position.x, position.y, position.z}, PRELIGHT_NO_TRIANGLE, {0, 1, 0}, seed, {0, 1, 0}, 0};
}

/// Returns a few unoccluded points above the floor.
std::vector<device::Receiver> placesOver(double half) {
  Random random(81);
  std::vector<device::Receiver> places;
  for (std::uint32_t i = 0; i < 8; ++i)
    places.push_back(lookingUp(
        glm::vec3(half * random.between(-0.9, 0.9), 1e-3 * half, half * random.between(-0.9, 0.9)), i));
  return places;
}

double exactIrradiance(const Light& light, const glm::dvec3& point) {
  const double intensity = light.intensity.x;
  if (light.type == LightType::Directional)
    return std::max(-glm::dot(light.direction, glm::dvec3(0, 1, 0)), 0.0) * intensity;
  const glm::dvec3 way = light.position - point;
  const double d = glm::length(way);
  return intensity * std::max(way.y, 0.0) / (d * d * d);
}

/// Returns the light with position and direction rounded to float, since rounding moves a light and is no
/// error of sums.
Light rounded(Light light) {
  light.position = glm::dvec3(glm::vec3(light.position));
  light.direction = glm::dvec3(glm::vec3(light.direction));
  return light;
}

void lightPlaces(const char* stress, double half, const std::vector<Light>& lights, double bound,
                 Growth growth, Trials& trials) {
  const CompiledScene scene = floorScene(half, 1, matte(0.5));
  Tracer tracer(scene, trials.device());
  DirectLight direct(scene, tracer);
  RadiosityLights all;
  all.punctual = lights;
  direct.setLights(all);
  const std::vector<device::Receiver> places = placesOver(half);
  const std::vector<PointIrradiance> got = direct.at(places);
  const std::vector<float> incident = lights.size() < 1000 ? direct.incidentAt(places) : std::vector<float>();
  Differences differences;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::dvec3 point(places[i].position[0], places[i].position[1], places[i].position[2]);
    double truth = 0.0;
    for (const Light& light : lights) truth += exactIrradiance(rounded(light), point);
    for (int c = 0; c < 3; ++c) differences.add(got[i].far[c], truth);
    if (!incident.empty()) differences.add(incident[15 * i], truth);
    for (std::size_t k = 0; k < incident.size(); k += places.size())
      differences.add(incident[k], incident[k]);
  }
  trials.record(stress, differences, bound, std::move(growth));
}

std::vector<Light> crowd(std::size_t count, double half) {
  Random random(82);
  std::vector<Light> lights;
  for (std::size_t i = 0; i < count; ++i)
    lights.push_back(
        pointLight(half * glm::dvec3(random.between(-1, 1), random.between(0.5, 1.5), random.between(-1, 1)),
                   random.between(0.5, 1.0) / double(count)));
  return lights;
}

/// Returns the irradiance of a triangle wholly above the horizon by Lambert's formula, in double precision.
double triangleIrradiance(const glm::dvec3& point, const std::array<glm::dvec3, 3>& corner, double radiance) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 a = glm::normalize(corner[k] - point), b = glm::normalize(corner[(k + 1) % 3] - point);
    const glm::dvec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    if (sine > 0.0) sum += std::atan2(sine, glm::dot(a, b)) * across.y / sine;
  }
  return 0.5 * std::abs(sum) * radiance;
}

/// Measures a lamp of two triangles of a given size and height above the points.
void lampOver(const char* stress, double size, double height, double aside, double radiance, Trials& trials) {
  CompiledScene scene = floorScene(size, 1, matte(0.0, radiance));
  for (glm::vec3& p : scene.positions) p.z = -p.z;  // faces down
  Tracer tracer(scene, trials.device());
  DirectLight direct(scene, tracer);
  direct.setLights({});
  std::vector<device::Receiver> places;
  for (std::uint32_t i = 0; i < 6; ++i)
    places.push_back(
        lookingUp(glm::vec3(aside + 0.13 * i * size, -height, 0.3 * aside + 0.07 * i * size), i));
  const std::vector<PointIrradiance> got = direct.at(places);
  Differences differences;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::dvec3 point(places[i].position[0], places[i].position[1], places[i].position[2]);
    double truth = 0.0;
    for (const glm::uvec3& t : scene.triangles)
      truth += triangleIrradiance(point,
                                  {glm::dvec3(scene.positions[t.x]), glm::dvec3(scene.positions[t.y]),
                                   glm::dvec3(scene.positions[t.z])},
                                  double(static_cast<float>(radiance)));
    for (int c = 0; c < 3; ++c) differences.add(got[i].emitters[c], truth);
  }
  // The error of Lambert's formula grows with the square of distance / size, up to 32 sizes.
  const double sizes = std::min(std::hypot(height, aside) / size, 32.0);
  trials.record(stress, differences, (32.0 + 4.0 * sizes * sizes) * unitRoundoff,
                {"distance over size", height / size});
}

reference::Film render(const CompiledScene& scene, const std::vector<Light>& lights, const Camera& camera,
                       reference::ReferenceRequest request, Trials& trials) {
  request.width = request.height = 6;
  reference::Film film(6, 6, request.parts);
  Progress progress;
  reference::ReferenceReport report;
  reference::renderReference({scene, noImages(), lights, camera}, request, trials.device(), progress, film,
                             report);
  return film;
}

/// Measures walls that emit and reflect, by paths that find light by chance alone: every path has the same
/// value.
void furnace(const char* stress, double half, const glm::dvec3& offset, double albedo, double emission,
             int depth, Trials& trials) {
  const CompiledScene scene = roomScene(half, 1, matte(albedo, emission), offset);
  reference::ReferenceRequest request;
  request.estimator = reference::Estimator::ScatterOnly;
  request.depth = request.rouletteDepth = depth;
  request.samples = 16;
  const Camera camera = cameraAt(offset, offset + half * glm::dvec3(0.3, -1.0, 0.2), 1.0);
  const double white = double(static_cast<float>(albedo));
  double truth = 0.0, left = double(static_cast<float>(emission));
  for (int k = 0; k < depth; ++k) {
    truth += left;
    left *= white;
  }
  Differences differences;
  for (const glm::vec3& pixel : render(scene, {}, camera, request, trials).picture().pixels)
    for (int c = 0; c < 3; ++c) differences.add(pixel[c], truth);
  // Each surface multiplies by a weight with 4 roundings; a path adds up to `depth` terms.
  trials.record(stress, differences, 8.0 * depth * unitRoundoff, {"segments of a path", double(depth)});
}

/// Measures direct light on a grey floor from equal lights, of which each path samples one.
void litFloor(const char* stress, double half, const std::vector<Light>& lights, double truth, double bound,
              Trials& trials) {
  const CompiledScene scene = floorScene(half, 1, matte(0.5));
  reference::ReferenceRequest request;
  request.depth = 2;
  request.samples = 16;
  const Camera camera = cameraAt({0.0, half, 0.0}, {0.01 * half, 0.0, 0.0}, 1e-3);
  Differences differences;
  for (const glm::vec3& pixel : render(scene, lights, camera, request, trials).picture().pixels)
    for (int c = 0; c < 3; ++c) differences.add(pixel[c], 0.5 * truth / pi);
  trials.record(stress, differences, bound, {"lights", double(lights.size())});
}

/// Measures whether the parts of a floor's light add up to the whole.
void partsOfFloor(const char* stress, double emission, double irradiance, Trials& trials) {
  const CompiledScene scene = floorScene(1.0, 1, matte(0.5, emission));
  reference::ReferenceRequest request;
  request.depth = 2;
  request.samples = 16;
  request.parts = true;
  const Camera camera = cameraAt({0.0, 1.0, 0.0}, {0.01, 0.0, 0.0}, 1e-3);
  const reference::Film film =
      render(scene, {farLight({0.0, -1.0, 0.0}, irradiance)}, camera, request, trials);
  const Picture picture = film.picture();
  std::vector<glm::dvec3> sums(film.pixelCount(), glm::dvec3(0.0));
  for (const PartPicture& part : film.partPictures())
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += glm::dvec3(part.pixels[i]);
  Differences differences;
  for (std::size_t i = 0; i < sums.size(); ++i)
    for (int c = 0; c < 3; ++c) differences.add(static_cast<float>(sums[i][c]), picture.pixels[i][c]);
  trials.record(stress, differences, 32.0 * unitRoundoff);
}

/// Measures an emitting floor that is seen through the backs of sheets that face it.
void pastBacks(const char* stress, double size, int sheets, Trials& trials) {
  std::vector<Sheet> stack = {{0.0, matte(0.0, 1.0)}};
  for (int i = 1; i <= sheets; ++i) stack.push_back({0.4 * size * i / sheets, matte(0.0), true});
  reference::ReferenceRequest request;
  request.depth = 1;
  request.samples = 16;
  const Camera camera = cameraAt({0.0, size, 0.0}, {0.01 * size, 0.0, 0.0}, 1e-3);
  Differences differences;
  for (const glm::vec3& pixel : render(stackScene(size, stack), {}, camera, request, trials).picture().pixels)
    for (int c = 0; c < 3; ++c) differences.add(pixel[c], 1.0);
  trials.record(stress, differences, 8.0 * unitRoundoff, {"sheets", double(sheets)});
}

/// Measures a ceiling above a lamp above a mirror: paths cannot find the mirrored light, photons do.
void pastAMirror(const char* stress, double size, Trials& trials) {
  Material mirror = matte(1.0);
  mirror.metallic = 1.0f;
  mirror.roughness = 0.0f;
  const CompiledScene scene = stackScene(2.0 * size, {{0.0, mirror}, {size, matte(0.5), true}});
  reference::ReferenceRequest request;
  request.samples = 64;
  request.depth = 3;
  const Camera camera = cameraAt({0.0, 0.8 * size, 0.0}, {0.01 * size, size, 0.0}, 0.1);
  const reference::Film film =
      render(scene, {pointLight({0.0, 0.5 * size, 0.0}, size * size)}, camera, request, trials);
  double mean = 0.0;
  for (const glm::vec3& pixel : film.picture().pixels) mean += double(pixel.g) / double(film.pixelCount());
  Differences differences;
  differences.add(static_cast<float>(mean), 0.5 / pi * (1.0 / 0.25 + 1.0 / 2.25));
  trials.record(stress, differences, 0.02);
}

/// Measures the guides of a denoiser for a camera that sees only a floor.
void guidesOfFloor(const char* stress, double half, double albedo, double emission, Trials& trials) {
  const CompiledScene scene = floorScene(half, 1, matte(albedo, emission));
  reference::ReferenceRequest request;
  request.samples = 16;
  request.width = request.height = 6;
  request.guides = true;
  const Camera camera = cameraAt({0.0, half, 0.0}, {0.01 * half, 0.0, 0.0}, 1e-3);
  reference::Film film(6, 6);
  Progress progress;
  reference::ReferenceReport report;
  reference::renderReference({scene, noImages(), {}, camera}, request, trials.device(), progress, film,
                             report);
  Differences differences;
  for (std::size_t i = 0; i < film.pixelCount(); ++i)
    for (int c = 0; c < 3; ++c) {
      differences.add(report.guides.albedo[i][c], std::min(albedo + emission, 1.0));
      differences.add(report.guides.normal[i][c], c == 1 ? 1.0 : 0.0);
    }
  trials.record(stress, differences, 8.0 * unitRoundoff);
}

/// Measures a point light in the middle of a hollow sphere: irradiance is even, a sum of powers of the
/// albedo.
void hollow(const char* stress, bool instant, double intensity, Trials& trials) {
  constexpr double albedo = 0.5, radius = 1.0;
  const CompiledScene scene = hollowSphere(radius, 3, matte(albedo));
  const std::vector<Light> lights = {pointLight(glm::dvec3(0.0), intensity)};
  const Camera camera = cameraAt(glm::dvec3(0.0, 0.05, 0.0), {0.1, -1.0, 0.2}, 1.0);
  const double truth = intensity / (radius * radius) / (1.0 - albedo) * albedo / pi;
  std::vector<glm::vec3> got;
  Progress progress;
  if (instant) {
    reference::ReferenceRequest request;
    request.integrator = reference::Integrator::Instant;
    request.samples = 16;
    got = render(scene, lights, camera, request, trials).picture().pixels;
  } else {
    GlobalIlluminationPictureRequest request;
    request.width = request.height = 6;
    request.texels = 512;
    request.indirect.photons = 20000;
    request.causticPhotons = 1000;
    Scene plain;
    GlobalIlluminationPictureReport report;
    Primitive primitive;
    primitive.positions = scene.positions;
    primitive.triangles = scene.triangles;
    plain.meshes.push_back({"sphere", {primitive}});
    plain.meshNodes.push_back({0, "sphere", 0, {glm::dmat4(1.0)}, 0});
    plain.materials = {matte(albedo)};
    const LitScene lit{scene, noImages(), lights};
    got = renderGlobalIllumination(plain, lit, camera, request, trials.device(), progress, report).pixels;
  }
  double mean = 0.0;
  Differences differences;
  for (const glm::vec3& pixel : got) {
    mean += double(pixel.x) / double(got.size());
    for (int c = 0; c < 3; ++c) differences.add(pixel[c], pixel[c]);
  }
  differences.add(mean, truth);
  trials.record(stress, differences, instant ? 0.1 : 0.05);
}

}  // namespace

void runDirectLight(Trials& trials) {
  const double few = 24.0 * unitRoundoff;
  for (const double distance : {1.0, 1e3, 1e6}) {
    const std::vector<Light> one = {
        pointLight({0.3 * distance, distance, 0.1 * distance}, distance * distance)};
    lightPlaces("a light farther and farther off", 1.0, one, few, {"distance over size", distance}, trials);
  }
  for (const double intensity : {1e-6, 1e6, 1e-30, 1e30})
    lightPlaces("intensities from 1e-30 to 1e30", 1.0, {pointLight({0.0, 1.0, 0.0}, intensity)}, few,
                {"intensity", intensity}, trials);
  lightPlaces("light from afar, grazing", 1.0, {farLight({1.0, -1e-3, 0.0}, 1.0)}, few, {}, trials);
  lightPlaces("light from afar, straight", 1.0, {farLight({0.0, -1.0, 0.0}, 1e6)}, few, {}, trials);
  lightPlaces("a floor of 1e-6 m", 1e-6, {pointLight({0.0, 1e-6, 0.0}, 1e-12)}, few, {}, trials);
  lightPlaces("a floor of 1e6 m", 1e6, {pointLight({0.0, 1e6, 0.0}, 1e12)}, few, {}, trials);
  for (std::size_t count = 1; count <= trials.options().lights; count *= 100)
    lightPlaces("more and more lights", 1.0, crowd(count, 1.0), few + 2048.0 * unitRoundoff,
                {"lights", double(count)}, trials);
  for (std::size_t count = 1; count <= trials.options().lights; count *= 100)
    lightPlaces("lights that are all alike", 1.0,
                std::vector<Light>(count, pointLight({0.0, 1.0, 0.0}, 1.0 / double(count))),
                few + 2048.0 * unitRoundoff, {"lights", double(count)}, trials);
  for (const double height : {1e-3, 1.0, 4.0, 10.0, 30.0, 100.0, 1e3, 1e4, 1e6}) {
    lampOver("a lamp overhead, farther and farther off", 1.0, height, 0.0, 1.0, trials);
    if (height >= 1.0)
      lampOver("a lamp aside, farther and farther off", 1.0, height, 1.2 * height, 1.0, trials);
  }
  lampOver("a lamp of 1e-6 m", 1e-6, 1e-6, 0.0, 1e-6, trials);
  lampOver("a lamp of 1e6 m and 1e6 W/m2 sr", 1e6, 1e6, 0.0, 1e6, trials);
}

void runPaths(Trials& trials) {
  for (const int depth : {1, 4, 16, 64})
    furnace("a furnace of albedo 0.999", 1.0, glm::dvec3(0.0), 0.999, 1.0, depth, trials);
  furnace("albedo 0", 1.0, glm::dvec3(0.0), 0.0, 1.0, 8, trials);
  furnace("albedo 1", 1.0, glm::dvec3(0.0), 1.0, 1.0, 256, trials);
  furnace("emission of 1e-6", 1.0, glm::dvec3(0.0), 0.5, 1e-6, 16, trials);
  furnace("emission of 1e6", 1.0, glm::dvec3(0.0), 0.5, 1e6, 16, trials);
  furnace("a room of 1e-6 m", 1e-6, glm::dvec3(0.0), 0.5, 1.0, 16, trials);
  furnace("a room of 1e6 m", 1e6, glm::dvec3(0.0), 0.5, 1.0, 16, trials);
  furnace("a room 1e6 m from zero", 1.0, glm::dvec3(1e6, -1e6, 5e5), 0.5, 1.0, 16, trials);
  const double few = 32.0 * unitRoundoff;
  litFloor("a light from afar", 1.0, {farLight({0.0, -1.0, 0.0}, 2.0)}, 2.0, few, trials);
  litFloor("a light 1e6 times farther than the scene is large", 1.0, {pointLight({0.0, 1e6, 0.0}, 1e12)}, 1.0,
           few, trials);
  litFloor("intensity of 1e30", 1.0, {farLight({0.0, -1.0, 0.0}, 1e30)}, 1e30, few, trials);
  for (std::size_t count = 100; count <= trials.options().lights; count *= 100)
    litFloor("lights that are all alike", 1.0,
             std::vector<Light>(count, farLight({0.0, -1.0, 0.0}, 1.0 / double(count))), 1.0,
             few + double(count) * 0x1p-32, trials);
  partsOfFloor("parts of a floor's light", 1e-3, 1.0, trials);
  partsOfFloor("parts of a floor that emits 1e6", 1e6, 1e-3, trials);
  for (const int sheets : {1, 4, 32}) pastBacks("backs between the eye and a floor", 1.0, sheets, trials);
  pastBacks("backs of 1e6 m", 1e6, 2, trials);
  for (const double size : {1e-3, 1.0, 1e3}) pastAMirror("a lamp over a mirror", size, trials);
  guidesOfFloor("guides of a floor", 1.0, 0.75, 0.0, trials);
  guidesOfFloor("guides of a floor that emits 1e30", 1.0, 0.5, 1e30, trials);
  guidesOfFloor("guides of a floor of 1e6 m", 1e6, 0.0, 0.0, trials);
}

void runPictures(Trials& trials) {
  for (const double intensity : {1e-6, 1.0, 1e6}) {
    hollow("instant radiosity in a hollow sphere", true, intensity, trials);
    hollow("full shading in a hollow sphere", false, intensity, trials);
  }
}

}  // namespace prelight::benchmarks::stability
