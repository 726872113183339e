#include "plot/sky_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/kept_sky.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_projection.h"

namespace prelight::plot {
namespace {

/// Returns the mean radiance of the sky's texels over each texel of a map.
std::vector<glm::vec3> sampled(const Environment& sky) {
  constexpr int samples = 4;  // along each axis
  std::vector<glm::vec3> result;
  for (int y = 0; y < mapHeight; ++y)
    for (int x = 0; x < mapWidth; ++x) {
      glm::vec3 sum(0.0f);
      for (int i = 0; i < samples * samples; ++i) {
        const double u = (x + (i % samples + 0.5) / samples) / mapWidth;
        const double v = (y + (i / samples + 0.5) / samples) / mapHeight;
        const int column = std::min(static_cast<int>(u * sky.width), sky.width - 1);
        const int row = std::min(static_cast<int>(v * sky.height), sky.height - 1);
        sum += sky.radiance[static_cast<std::size_t>(row) * sky.width + column];
      }
      result.push_back(sum / static_cast<float>(samples * samples));
    }
  return result;
}

/// Returns the root of the ratio of the squared difference to the square, both integrated over the sphere.
double relativeError(const std::vector<glm::vec3>& values, const std::vector<glm::vec3>& truth) {
  double difference = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double weight = std::sin(std::numbers::pi * (static_cast<double>(i / mapWidth) + 0.5) / mapHeight);
    const glm::dvec3 d = glm::dvec3(values[i]) - glm::dvec3(truth[i]);
    difference += weight * glm::dot(d, d);
    whole += weight * glm::dot(glm::dvec3(truth[i]), glm::dvec3(truth[i]));
  }
  return whole > 0.0 ? std::sqrt(difference / whole) : 0.0;
}

Color shown(const glm::vec3& radiance, float exposure) {
  if (radiance.r + radiance.g + radiance.b < 0.0f) return belowZeroColor;
  const glm::vec3 color = toneMap(exposure * radiance);
  Color result;
  for (int c = 0; c < 3; ++c)
    result[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(255.0f * color[c]));
  return result;
}

float exposureOf(const SkyRow& row) {
  return static_cast<float>(meteredExposure({mapWidth, mapHeight, row.radiance}));
}

void drawMap(Drawing& drawing, int top, const SkyRow& row, float exposure) {
  for (int y = 0; y < mapHeight; ++y)
    for (int x = 0; x < mapWidth; ++x)
      drawing.set(x, top + y, shown(row.radiance[static_cast<std::size_t>(y) * mapWidth + x], exposure));
}

}  // namespace

std::vector<glm::dvec3> directionsOfMap() {
  std::vector<glm::dvec3> directions;
  for (int y = 0; y < mapHeight; ++y)
    for (int x = 0; x < mapWidth; ++x)
      directions.push_back(Environment::direction((x + 0.5) / mapWidth, (y + 0.5) / mapHeight));
  return directions;
}

SkyRow skyItself(const Environment& sky) { return {"the sky", sampled(sky), 0.0}; }

SkyRow skyInHarmonics(const Environment& sky, int order) {
  const std::vector<double> light = sh::projectEnvironment(sky, order);
  const std::size_t count = static_cast<std::size_t>(order) * order;
  SkyRow row;
  std::vector<double> values(count);
  for (const glm::dvec3& direction : directionsOfMap()) {
    sh::evaluate(direction, order, values);
    glm::dvec3 sum(0.0);
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < count; ++i)
        sum[c] += light[static_cast<std::size_t>(c) * count + i] * values[i];
    row.radiance.emplace_back(sum);
  }
  row.error = relativeError(row.radiance, sampled(sky));
  row.caption = fmt::format("SH of order {}, {} coefficients: {:.3g} off", order, count, row.error);
  return row;
}

SkyRow skyInWavelets(const Environment& sky, int faceSize, std::size_t terms) {
  const std::vector<glm::vec3> texels = skyOfWavelets(sky, faceSize, terms);
  SkyRow row;
  for (const glm::dvec3& direction : directionsOfMap())
    row.radiance.push_back(texels[cubeTexel(direction, faceSize)]);
  row.error = relativeError(row.radiance, sampled(sky));
  row.caption =
      fmt::format("{} of {} wavelets: {:.3g} off", std::min(terms, texels.size()), texels.size(), row.error);
  return row;
}

Drawing plotSkies(std::span<const SkyRow> rows) {
  Drawing drawing = blankDrawing(mapWidth, static_cast<int>(rows.size()) * (mapHeight + captionHeight));
  const float exposure = exposureOf(rows.front());
  int top = 0;
  for (const SkyRow& row : rows) {
    drawMap(drawing, top, row, exposure);
    drawing.labels.push_back({{mapWidth / 2, top + mapHeight + 14}, row.caption});
    top += mapHeight + captionHeight;
  }
  return drawing;
}

Drawing plotSkyLights(const Environment& sky, std::span<const SkyLight> lights) {
  Drawing drawing = blankDrawing(mapWidth, mapHeight + captionHeight);
  const SkyRow itself = skyItself(sky);
  drawMap(drawing, 0, itself, 0.5f * exposureOf(itself));
  double greatest = 0.0;
  const auto strengthOf = [](const SkyLight& light) {
    return light.irradiance.r + light.irradiance.g + light.irradiance.b;
  };
  for (const SkyLight& light : lights) greatest = std::max(greatest, strengthOf(light));
  for (const SkyLight& light : lights) {
    const glm::dvec2 place = Environment::coordinates(light.direction) * glm::dvec2(mapWidth, mapHeight);
    addCircle(drawing, place, 2.0 + 10.0 * std::sqrt(strengthOf(light) / greatest), {255, 40, 40}, 2.0);
  }
  drawing.labels.push_back({{mapWidth / 2, mapHeight + 14}, fmt::format("{} lights", lights.size())});
  return drawing;
}

}  // namespace prelight::plot
