#include "benchmarks/lab/hemicube.h"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace prelight {

namespace {

void store(float (&out)[3], const glm::dvec3& v) {
  for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(v[c]);
}

}  // namespace

std::vector<HemicubePixel> makeHemicube(int size) {
  std::vector<HemicubePixel> pixels;
  const double step = 2.0 / size, area = step * step;
  double sum = 0.0;
  // Delta form factor: cosine at the element x cosine at the pixel x area / (pi distance^2).
  const auto add = [&](const glm::dvec3& centre) {
    const double squared = glm::dot(centre, centre);
    pixels.push_back({centre / std::sqrt(squared), centre.z * area / (std::numbers::pi * squared * squared)});
    sum += pixels.back().share;
  };
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const double u = (i + 0.5) * step - 1.0, v = (j + 0.5) * step - 1.0;
      add({u, v, 1.0});
      if (v < 0.0) continue;
      for (const double side : {-1.0, 1.0}) {
        add({side, u, v});
        add({u, side, v});
      }
    }
  for (HemicubePixel& pixel : pixels) pixel.share /= sum;
  return pixels;
}

HemicubeCast::HemicubeCast(const CompiledScene& scene, const RadiosityElements& elements, Tracer& tracer,
                           int size)
    : scene_(scene), elements_(elements), tracer_(tracer), pixels_(makeHemicube(size)) {}

std::vector<std::pair<std::uint32_t, double>> HemicubeCast::row(const ElementPoints& points,
                                                                std::uint32_t element, std::uint32_t count) {
  const std::uint32_t triangle = elements_.triangleOf(element);
  std::vector<device::Ray> rays;
  for (std::uint32_t p = 0; p < count; ++p) {
    const device::Receiver receiver = points.at(element, triangle, p, 1).receiver;
    const glm::dvec3 normal(receiver.normal[0], receiver.normal[1], receiver.normal[2]);
    const glm::dvec3 aside = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(aside, normal)), y = glm::cross(normal, x);
    for (const HemicubePixel& pixel : pixels_) {
      device::Ray ray{};
      for (int c = 0; c < 3; ++c) ray.origin[c] = receiver.position[c];
      store(ray.direction, pixel.direction.x * x + pixel.direction.y * y + pixel.direction.z * normal);
      ray.sourceTriangle = triangle;
      ray.tMax = std::numeric_limits<float>::max();
      rays.push_back(ray);
    }
  }
  const std::vector<device::Hit> hits = tracer_.traceClosest(rays);
  std::map<std::uint32_t, double> row;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const device::Hit& hit = hits[i];
    if (hit.triangle == PRELIGHT_NO_TRIANGLE) continue;
    const glm::dvec3 d(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]);
    const bool back = glm::dot(d, orientedNormal(scene_, hit.triangle)) > 0.0;
    const std::uint32_t met = elements_.first[hit.triangle] +
                              pieceAt(elements_.splits[hit.triangle], hit.u, hit.v) +
                              (back ? elements_.perSide() : 0);
    row[met] += pixels_[i % pixels_.size()].share / count;
  }
  return {row.begin(), row.end()};
}

}  // namespace prelight
