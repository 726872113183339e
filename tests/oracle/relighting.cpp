#include "oracle/relighting.h"

#include "basis/sh.h"

namespace prelight::reference {

std::vector<glm::dvec3> relightGroups(const LightGroupTransfer& transfer,
                                      std::span<const glm::dvec3> colors) {
  const std::size_t groups = transfer.groups.size(), channels = static_cast<std::size_t>(transfer.channels);
  std::vector<glm::dvec3> out(groups == 0 ? 0 : transfer.coefficients.size() / (groups * channels),
                              glm::dvec3(0.0));
  for (std::size_t v = 0; v < out.size(); ++v)
    for (int c = 0; c < 3; ++c) {
      const std::size_t row = v * channels + (channels == 1 ? 0 : static_cast<std::size_t>(c));
      for (std::size_t g = 0; g < groups; ++g)
        out[v][c] += colors[g][c] * double(transfer.coefficients[row * groups + g]);
    }
  return out;
}

std::vector<glm::dvec3> relightHaar(const HaarTransfer& transfer, std::span<const haar::LitWavelet> light) {
  const auto texels = static_cast<std::size_t>(6 * transfer.faceSize * transfer.faceSize);
  std::vector<glm::dvec3> table(texels, glm::dvec3(0.0));
  for (const haar::LitWavelet& lit : light) table[lit.index] += glm::dvec3(lit.color);
  const auto channels = static_cast<std::size_t>(transfer.channels);
  std::vector<glm::dvec3> out((transfer.offsets.size() - 1) / channels, glm::dvec3(0.0));
  for (std::size_t v = 0; v < out.size(); ++v)
    for (int c = 0; c < 3; ++c) {
      const std::size_t row = v * channels + (channels == 1 ? 0 : static_cast<std::size_t>(c));
      for (std::size_t at = transfer.offsets[row]; at < transfer.offsets[row + 1]; ++at)
        out[v][c] += double(transfer.values[at]) * table[transfer.indices[at]][c];
    }
  return out;
}

std::vector<double> lightMatrices(const GlossyTransfer& transfer, std::span<const double> light) {
  const auto n = static_cast<std::size_t>(transfer.order * transfer.order);
  const auto channels = static_cast<std::size_t>(transfer.channels);
  const std::size_t vertices = transfer.matrices.size() / (channels * n * n);
  std::vector<double> out(vertices * 3 * n, 0.0);
  for (std::size_t v = 0; v < vertices; ++v)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < n; ++i) {
        const float* row = transfer.matrices.data() + ((v * channels + (channels == 1 ? 0 : c)) * n + i) * n;
        for (std::size_t j = 0; j < n; ++j) out[(v * 3 + c) * n + i] += double(row[j]) * light[c * n + j];
      }
  return out;
}

std::vector<glm::dvec3> shadeGlossy(std::span<const double> arriving, int order,
                                    std::span<const glm::dvec3> directions, std::span<const double> lobe) {
  const auto n = static_cast<std::size_t>(order * order);
  std::vector<double> values(n);
  std::vector<glm::dvec3> out;
  for (std::size_t v = 0; v < directions.size(); ++v) {
    sh::evaluate(directions[v], order, values);
    glm::dvec3 color(0.0);
    for (std::size_t l = 0; l < lobe.size(); ++l)
      for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i)
        for (std::size_t c = 0; c < 3; ++c)
          color[static_cast<int>(c)] += lobe[l] * values[i] * arriving[(v * 3 + c) * n + i];
    out.push_back(color);
  }
  return out;
}

}  // namespace prelight::reference
