#include "basis/haar_selection.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "basis/haar.h"
#include "basis/haar_cut.h"

namespace prelight::haar {
namespace {

/// Returns the indices of the `count` greatest magnitudes above 0, ascending by index.
std::vector<std::uint32_t> greatest(std::span<const float> magnitudes, std::size_t count) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < magnitudes.size(); ++i) {
    if (magnitudes[i] > 0.0f) indices.push_back(i);
  }
  if (indices.size() > count) {
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      return magnitudes[a] != magnitudes[b] ? magnitudes[a] > magnitudes[b] : a < b;
    };
    std::nth_element(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(count), indices.end(),
                     before);
    indices.resize(count);
    std::sort(indices.begin(), indices.end());
  }
  return indices;
}

glm::vec3 lightAt(std::span<const float> light, std::uint32_t i) {
  const std::size_t count = light.size() / 3;
  return {light[i], light[count + i], light[2 * count + i]};
}

}  // namespace

SparseRow keepError(std::span<const float> coefficients, double relativeError) {
  SparseRow row;
  std::vector<std::size_t> ends;
  RowCutter(coefficients.size()).cut(coefficients, {}, 1, relativeError, row, ends);
  return row;
}

SparseRow keepLargest(std::span<const float> coefficients, std::size_t count,
                      std::span<const float> weights) {
  assert(weights.empty() || weights.size() == coefficients.size());
  std::vector<float> magnitudes(coefficients.size());
  for (std::size_t i = 0; i < magnitudes.size(); ++i) {
    magnitudes[i] = std::abs(coefficients[i]) * (weights.empty() ? 1.0f : weights[i]);
  }
  SparseRow row{greatest(magnitudes, count), {}};
  for (const std::uint32_t i : row.indices) row.values.push_back(coefficients[i]);
  return row;
}

std::vector<float> areaWeights(int faceSize) {
  const CubeTexels texels(faceSize);
  // The supports of one size tile the face: solid angles are summed over blocks of quadrupling area, then
  // divided by the size.
  std::vector<double> sums(texels.count() / cubeFaces);
  for (std::uint32_t i = 0; i < sums.size(); ++i) sums[i] = texels.solidAngle(i);
  std::vector<float> face(sums.size());
  const auto size = static_cast<std::size_t>(faceSize);
  for (std::size_t half = 1; half < size; half *= 2) {
    for (std::size_t row = 0; row < size; row += 2 * half) {
      for (std::size_t column = 0; column < size; column += 2 * half) {
        const std::size_t p = row * size + column, q = p + half, s = p + half * size, t = s + half;
        sums[p] += sums[q] + sums[s] + sums[t];
        face[q] = face[s] = face[t] = static_cast<float>(sums[p] / (2.0 * static_cast<double>(half)));
      }
    }
  }
  face[0] = static_cast<float>(sums[0] / static_cast<double>(size));
  std::vector<float> weights;
  for (int f = 0; f < cubeFaces; ++f) weights.insert(weights.end(), face.begin(), face.end());
  return weights;
}

std::vector<float> transformLight(const CubeMap& map) {
  checkCubeMap(map, "cube map");
  const std::size_t count = map.radiance.size();
  std::vector<float> light(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) light[static_cast<std::size_t>(c) * count + i] = map.radiance[i][c];
  }
  for (std::size_t c = 0; c < 3; ++c)
    forward(std::span<float>(light).subspan(c * count, count), map.faceSize);
  return light;
}

std::vector<float> lightMagnitudes(std::span<const float> light, std::span<const float> weights) {
  assert(light.size() == 3 * weights.size());
  std::vector<float> magnitudes(weights.size());
  for (std::uint32_t i = 0; i < magnitudes.size(); ++i)
    magnitudes[i] = glm::length(lightAt(light, i)) * weights[i];
  return magnitudes;
}

SparseLight selectLight(std::span<const float> light, std::span<const float> weights, std::size_t count) {
  SparseLight selection{greatest(lightMagnitudes(light, weights), count), {}};
  for (const std::uint32_t i : selection.indices) selection.values.push_back(lightAt(light, i));
  return selection;
}

SparseLight selectLightSoftly(std::span<const float> light, std::span<const float> weights, std::size_t count,
                              float fade) {
  assert(fade > 1.0f);
  const std::vector<float> magnitudes = lightMagnitudes(light, weights);
  const std::vector<std::uint32_t> kept = greatest(magnitudes, count);
  std::vector<float> others = magnitudes;
  for (const std::uint32_t i : kept) others[i] = 0.0f;
  const float limit = others.empty() ? 0.0f : *std::max_element(others.begin(), others.end());
  SparseLight selection;
  for (const std::uint32_t i : kept) {
    const float factor = std::min((1.0f - limit / magnitudes[i]) * fade / (fade - 1.0f), 1.0f);
    if (factor <= 0.0f) continue;
    selection.indices.push_back(i);
    selection.values.push_back(factor * lightAt(light, i));
  }
  return selection;
}

SparseLight SteadySelection::next(std::span<const float> light, std::span<const float> weights) {
  std::vector<float> magnitudes = lightMagnitudes(light, weights);
  const bool first = chosen_.size() != magnitudes.size();
  if (first) {
    chosen_.assign(magnitudes.size(), false);
    presence_.assign(magnitudes.size(), 0.0f);
  }
  for (std::size_t i = 0; i < magnitudes.size(); ++i) {
    if (chosen_[i]) magnitudes[i] *= 1.0f + hysteresis_;
  }
  std::fill(chosen_.begin(), chosen_.end(), false);
  for (const std::uint32_t i : greatest(magnitudes, count_)) chosen_[i] = true;
  SparseLight selection;
  for (std::uint32_t i = 0; i < presence_.size(); ++i) {
    const float target = chosen_[i] ? 1.0f : 0.0f;
    presence_[i] = first ? target : std::clamp(target, presence_[i] - step_, presence_[i] + step_);
    if (presence_[i] <= 0.0f) continue;
    selection.indices.push_back(i);
    selection.values.push_back(presence_[i] * lightAt(light, i));
  }
  return selection;
}

double expectedError(std::span<const float> light, const SparseLight& part, std::span<const float> weights) {
  double total = 0.0, missing = 0.0;
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    const glm::dvec3 whole(lightAt(light, i));
    glm::dvec3 rest = whole;
    if (next < part.indices.size() && part.indices[next] == i) rest -= glm::dvec3(part.values[next++]);
    const double square = static_cast<double>(weights[i]) * weights[i];
    total += square * glm::dot(whole, whole);
    missing += square * glm::dot(rest, rest);
  }
  return total > 0.0 ? std::sqrt(missing / total) : 0.0;
}

}  // namespace prelight::haar
