#include "basis/kept_sky.h"

#include <algorithm>

#include "basis/haar.h"

namespace prelight {

std::vector<double> faceWavelets(int faceSize) {
  const int texels = faceSize * faceSize;
  std::vector<double> values;
  for (int index = 0; index < texels; ++index) {
    const haar::Wavelet wavelet = haar::waveletOf(static_cast<std::uint32_t>(index), faceSize);
    for (int texel = 0; texel < texels; ++texel)
      values.push_back(haar::valueAt(wavelet, texel / faceSize, texel % faceSize));
  }
  return values;
}

std::vector<glm::vec3> skyOfWavelets(const Environment& sky, int faceSize, std::size_t kept) {
  const std::vector<float> light = haar::transformLight(cubeFromEnvironment(sky, faceSize));
  const std::size_t count = cubeTexelCount(faceSize);
  const haar::SparseLight part =
      haar::selectLight(light, std::vector<float>(count, 1.0f), std::min(kept, count));
  std::vector<glm::vec3> texels(count);
  for (int c = 0; c < 3; ++c) {
    std::vector<float> channel(count);
    for (std::size_t i = 0; i < part.indices.size(); ++i) channel[part.indices[i]] = part.values[i][c];
    haar::inverse(channel, faceSize);
    for (std::size_t i = 0; i < count; ++i) texels[i][c] = channel[i];
  }
  return texels;
}

}  // namespace prelight
