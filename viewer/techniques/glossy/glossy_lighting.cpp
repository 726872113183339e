#include "viewer/techniques/glossy/glossy_lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/colour.h"
#include "base/parallel.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"
#include "relight/sky_ringing.h"
#include "scene/lobes.h"
#include "techniques/glossy/glossy.h"
#include "techniques/glossy/glossy_relighter.h"
#include "viewer/lights/receiver_lamps.h"
#include "viewer/programs/drawn_shading.h"
#include "viewer/techniques/glossy/measured_lobes.h"

namespace prelight::viewer {
namespace {

const double fourPi = 4.0 * std::numbers::pi;

std::size_t coefficientCount(const GlossyTransfer& transfer) {
  return static_cast<std::size_t>(transfer.order * transfer.order);
}

/// [vertex][3][i]
std::vector<float> multiply(const GlossyTransfer& transfer, const std::vector<double>& light) {
  const std::size_t n = coefficientCount(transfer);
  const auto channels = static_cast<std::size_t>(transfer.channels);
  const std::vector<float> l(light.begin(), light.end());
  std::vector<float> result(transfer.matrices.size() / (channels * n * n) * 3 * n);
  for (std::size_t row = 0; row < result.size(); ++row) {
    const std::size_t i = row % n, c = row / n % 3, v = row / (3 * n);
    const std::size_t matrix = v * channels + std::min(c, channels - 1);
    const float* m = transfer.matrices.data() + (matrix * n + i) * n;
    float sum = 0.0f;
    for (std::size_t j = 0; j < n; ++j) sum += m[j] * l[c * n + j];
    result[row] = sum;
  }
  return result;
}

/// Sets rows, [i] RGB, to the matrices of a vertex times the coefficients of a white light.
void multiplyVertex(const GlossyTransfer& transfer, std::size_t vertex, const std::vector<double>& light,
                    std::vector<glm::dvec3>& rows) {
  const std::size_t n = coefficientCount(transfer);
  const auto channels = static_cast<std::size_t>(transfer.channels);
  rows.assign(n, glm::dvec3(0.0));
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t matrix = vertex * channels + std::min(c, channels - 1);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        rows[i][static_cast<int>(c)] += double(transfer.matrices[(matrix * n + i) * n + j]) * light[j];
  }
}

}  // namespace

std::vector<float> glossyAccessibility(const GlossyTransfer& transfer) {
  // T_0 sqrt(4 pi), and T_0 = sqrt(4 pi) M_00.
  const std::size_t matrix = coefficientCount(transfer) * coefficientCount(transfer);
  const auto channels = static_cast<std::size_t>(transfer.channels);
  std::vector<float> result(transfer.matrices.size() / (matrix * channels));
  for (std::size_t v = 0; v < result.size(); ++v) {
    double sum = 0.0;
    for (std::size_t c = 0; c < channels; ++c) sum += fourPi * transfer.matrices[(v * channels + c) * matrix];
    result[v] = static_cast<float>(std::clamp(sum / static_cast<double>(channels), 0.0, 1.0));
  }
  return result;
}

GlossyLighting::GlossyLighting(const GlossyTransfer& transfer, const CompiledScene& scene, Lobe lobe,
                               const Device* device)
    : transfer_(transfer),
      scene_(scene),
      device_(device),
      lobe_(lobe),
      lobes_(gl::makeBufferTexture(std::span<const glm::vec2>(makeLobeTable(lobe, transfer.order).texels()),
                                   1, GL_RG32F, "lobes")),
      measuredLobes_(gl::makeBufferTexture(measuredLobes(scene, transfer.order), "measured lobes")),
      accessibility_(Attribute::Accessibility, std::span<const float>(glossyAccessibility(transfer))),
      radiance_(Attribute::Radiance, std::span<const glm::vec3>()),
      highlights_(Attribute::Highlight, std::span<const float>()),
      visibility_(transfer.order),
      lampsInMatrices_(std::ranges::any_of(scene.materials, hasMeasuredLobe)) {}

GlossyLighting::~GlossyLighting() = default;

std::vector<float> GlossyLighting::arriving(const std::vector<double>& light) {
  if (device_ == nullptr) return multiply(transfer_, light);
  if (relighter_ == nullptr) relighter_ = std::make_unique<GlossyRelighter>(device_->context(), transfer_);
  relighter_->light(light);
  return relighter_->arriving();
}

/// Keeps the diffuse radiance of a sky, [vertex], from what its ringing makes of it; `smoothed`: the smoothed
/// sky, [channel][i].
void GlossyLighting::boundRinging(const std::vector<double>& smoothed,
                                  std::vector<glm::vec3>& diffuse) const {
  const std::size_t n = coefficientCount(transfer_);
  const auto channels = static_cast<std::size_t>(transfer_.channels);
  parallelRanges(diffuse.size(), lampReceivers, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      for (std::size_t c = 0; c < 3; ++c) {
        const float* row = transfer_.matrices.data() + (v * channels + std::min(c, channels - 1)) * n * n;
        double sum = 0.0;
        for (std::size_t j = 0; j < n; ++j) sum += double(row[j]) * smoothed[c * n + j];
        float& shown = diffuse[v][static_cast<int>(c)];
        shown = static_cast<float>(withoutRinging(shown, std::sqrt(fourPi) * sum));
      }
  });
}

/// Adds the light of lamps to the diffuse radiance, [vertex], and to what arrives for lobes, [vertex][3][i]:
/// what bounces send of it, as light that arrives evenly; the lamps themselves where lobes are measured, else
/// their shares for highlights, [vertex].
void GlossyLighting::addLamps(const std::vector<ShadedLight>& lamps, LitVertices& lit) const {
  const std::size_t n = coefficientCount(transfer_);
  parallelRanges(lit.diffuse.size(), lampReceivers, [&](std::size_t begin, std::size_t end) {
    std::vector<double> basis(n), even(n);
    std::vector<glm::dvec3> rows;
    for (std::size_t v = begin; v < end; ++v) {
      const glm::dvec3 normal(scene_.normals[v]);
      sh::openTransfer(normal, transfer_.order, even);
      double sent = 0.0, arrived = 0.0;
      for (const ShadedLight& lamp : lamps) {
        const SeenLamp seen = seenFrom(lamp, glm::dvec3(scene_.positions[v]), normal);
        if (!seen.shines()) continue;
        sh::evaluate(seen.toLamp, transfer_.order, basis);
        multiplyVertex(transfer_, v, basis, rows);
        const glm::dvec3 seenMean = MatrixVisibility::mean(rows, basis);
        const double open = std::max(visibility_.open(seen.cosine), 1e-9);
        ArrivingLamp arriving = arrivingLamp(seen, seenMean, open, shadowSlope);
        if (transfer_.bounces >
            0) {  // which the mean knows next to nothing of: what is lit from behind sends none
          const glm::dvec3 share = glm::clamp(seenMean / open, 0.0, 1.0);
          arriving.bounced =
              std::sqrt(fourPi) * rows[0] - share * sh::openTowards(seen.cosine, transfer_.order);
        }
        const double facing = std::max(seen.cosine, 0.0) / std::numbers::pi;
        const glm::dvec3 bounced = glm::max(seen.irradiance * arriving.bounced, 0.0);
        lit.diffuse[v] +=
            glm::vec3(glm::max(seen.irradiance * (arriving.bounced + arriving.direct * facing), 0.0));
        lit.bounced[v] += glm::vec3(bounced);
        for (std::size_t i = 0; i < n; ++i)
          for (int c = 0; c < 3; ++c)
            lit.arriving[(3 * v + static_cast<std::size_t>(c)) * n + i] +=
                static_cast<float>(lampsInMatrices_ ? seen.irradiance[c] * rows[i][c] : bounced[c] * even[i]);
        const double strength = luminance(glm::vec3(seen.irradiance)) * std::max(seen.cosine, 0.0);
        sent += strength;
        arrived += strength * luminance(glm::vec3(arriving.direct));
      }
      if (sent > 0.0) lit.highlights[v] = static_cast<float>(arrived / sent);
    }
  });
}

void GlossyLighting::light(const Illumination& light) {
  LitVertices lit{arriving(byChannel(skyCoefficients(light, transfer_.order))), {}, {}, {}};
  const std::size_t n = coefficientCount(transfer_);
  lit.diffuse.resize(lit.arriving.size() / (3 * n));
  for (std::size_t v = 0; v < lit.diffuse.size(); ++v)
    for (int c = 0; c < 3; ++c)
      lit.diffuse[v][c] =
          lit.arriving[(3 * v + static_cast<std::size_t>(c)) * n] * static_cast<float>(std::sqrt(fourPi));
  boundRinging(byChannel(smoothedCoefficients(light, transfer_.order)), lit.diffuse);
  std::vector<glm::vec3> mean = lit.diffuse;
  lit.bounced.resize(mean.size());
  lit.highlights.assign(mean.size(), 1.0f);
  const std::vector<ShadedLight> lamps = transferredLights(light);
  lampsShine_ = !lamps.empty();
  if (lampsShine_) addLamps(lamps, lit);
  for (std::size_t v = 0; v < mean.size(); ++v) {
    lit.diffuse[v] = glm::max(lit.diffuse[v], glm::vec3(0.0f));
    // Lobes have the mean of the light that is shown diffusely.
    mean[v] = lampsInMatrices_ ? lit.diffuse[v] : glm::max(mean[v] + lit.bounced[v], glm::vec3(0.0f));
    for (int c = 0; c < 3; ++c)
      lit.arriving[(3 * v + static_cast<std::size_t>(c)) * n] =
          mean[v][c] / static_cast<float>(std::sqrt(fourPi));
  }
  std::vector<glm::vec4> texels(lit.arriving.size() / 3);
  for (std::size_t texel = 0; texel < texels.size(); ++texel) {
    const float* channel = lit.arriving.data() + texel / n * 3 * n + texel % n;
    texels[texel] = {channel[0], channel[n], channel[2 * n], 0.0f};
  }
  arriving_ = gl::makeBufferTexture(texels, "glossy light");
  radiance_.fill(std::span<const glm::vec3>(lit.diffuse));
  highlights_.fill(std::span<const float>(lit.highlights));
}

void GlossyLighting::bind(const gl::Program& program) const {
  program.set("glossyOrder", transfer_.order);
  program.set("lobeIsBrdf", lobe_ == Lobe::Phong ? 1 : 0);
  gl::bind(lobesUnit, GL_TEXTURE_BUFFER, lobes_.texture);
  gl::bind(measuredLobesUnit, GL_TEXTURE_BUFFER, measuredLobes_.texture);
  gl::bind(arrivingUnit, GL_TEXTURE_BUFFER, arriving_.texture);
  program.set("lampsInLobes", lampsInMatrices_ ? 0 : 1);
  accessibility_.attach();
  radiance_.attach();
  if (!lampsInMatrices_) highlights_.attach();
}

extern const DrawnShading drawnGlossy = {
    .info = &glossyShading,
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<DrawnTransfer> {
      return std::make_unique<GlossyLighting>(*of.inputs.bake->glossy, of.inputs.compiled, of.lobe,
                                              of.inputs.device);
    },
};

}  // namespace prelight::viewer
