#include "support/merl_files.h"

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "prelight/scene.h"
#include "scene/codecs/merl_brdf.h"
#include "scene/measured_brdf.h"

namespace prelight::test {

namespace {

using std::numbers::pi;

void append(std::vector<std::uint8_t>& bytes, const auto& value) {
  const std::size_t before = bytes.size();
  bytes.resize(before + sizeof(value));
  std::memcpy(&bytes[before], &value, sizeof(value));
}

}  // namespace

std::vector<DirectionPair> merlDirections() {
  std::vector<DirectionPair> pairs;
  for (int i = 0; i < 90; ++i)
    for (int j = 0; j < 90; ++j)
      for (int k = 0; k < 180; ++k) {
        const double half = 0.5 * pi * std::pow((i + 0.5) / 90.0, 2.0), apart = 0.5 * pi * (j + 0.5) / 90.0,
                     turn = pi * (k + 0.5) / 180.0;
        // The difference vector about +Z, tilted in the way that takes +Z to the half vector.
        const glm::dvec3 d(std::sin(apart) * std::cos(turn), std::sin(apart) * std::sin(turn),
                           std::cos(apart));
        const glm::dvec3 wi(std::cos(half) * d.x + std::sin(half) * d.z, d.y,
                            std::cos(half) * d.z - std::sin(half) * d.x);
        const glm::dvec3 h(std::sin(half), 0.0, std::cos(half));
        pairs.push_back({2.0 * glm::dot(wi, h) * h - wi, wi});
      }
  return pairs;
}

std::vector<std::uint8_t> merlFile(const Brdf& brdf) {
  constexpr std::array<double, 3> scales = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
  const std::vector<DirectionPair> pairs = merlDirections();
  std::array<std::vector<double>, 3> values;
  for (const DirectionPair& pair : pairs) {
    const bool above = pair.wo.z > 0.0 && pair.wi.z > 0.0;
    const glm::dvec3 value = above ? brdf(pair.wo, pair.wi) : glm::dvec3(0.0);
    for (int c = 0; c < 3; ++c)
      values[static_cast<std::size_t>(c)].push_back(above ? value[c] / scales[static_cast<std::size_t>(c)]
                                                          : -1.0);
  }
  std::vector<std::uint8_t> bytes;
  for (const std::int32_t size : {90, 90, 180}) append(bytes, size);
  for (const std::vector<double>& channel : values)
    for (const double value : channel) append(bytes, value);
  return bytes;
}

MeasuredBrdf tabulated(const Brdf& brdf) {
  Warnings warnings;
  return makeMeasuredBrdf(parseMerlBrdf(merlFile(brdf), "table"), "table", warnings);
}

Brdf ggxBrdf(const glm::dvec3& f0, double roughness) {
  return [=](const glm::dvec3& wo, const glm::dvec3& wi) {
    const glm::dvec3 h = glm::normalize(wo + wi);
    const double a2 = std::pow(roughness, 4.0), q = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
    const auto smith = [&](double c) { return std::sqrt(a2 + (1.0 - a2) * c * c); };
    return f0 * (a2 / (pi * q * q) * 0.5 / (wo.z * smith(wi.z) + wi.z * smith(wo.z)));
  };
}

CompiledMaterial measuredMaterial(std::shared_ptr<const MeasuredBrdf> brdf) {
  Scene scene;
  setMeasured(brdf, scene.materials.emplace_back());
  Warnings warnings;
  return compileScene(scene, warnings).materials.front();
}

}  // namespace prelight::test
