#include "viewer/techniques/series/series_transfer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/sh.h"
#include "compress/small_floats.h"
#include "viewer/lights/receiver_lamps.h"
#include "viewer/programs/surface_uniforms.h"

namespace prelight::viewer {
namespace {

template <typename T>
constexpr GLenum texelFormat() {
  if constexpr (std::is_same_v<T, float>) return GL_RGBA32F;
  if constexpr (std::is_same_v<T, std::uint16_t>) return GL_RGBA16F;
  return GL_RGBA8;
}

/// The numbers of a sky of radiance 1, with which transfer gives the accessibility.
std::vector<double> evenSky(int order, const ch::Basis* ch) {
  std::vector<double> numbers(sh::coefficientCount(order), 0.0);
  numbers[0] = std::sqrt(4.0 * std::numbers::pi);
  if (ch != nullptr) ch->momentsFromSh(numbers, numbers);
  return numbers;
}

/// Mean of the channels, [vertex]. `value` decodes number i of a row.
template <typename Value>
std::vector<float> seriesAccessibility(std::size_t vertices, int channels, std::span<const double> sky,
                                       const Value& value) {
  std::vector<float> result(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    double sum = 0.0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      for (std::size_t i = 0; i < sky.size(); ++i) {
        if (sky[i] != 0.0) sum += sky[i] * value((v * channels + c) * sky.size() + i, c, i);
      }
    }
    result[v] = static_cast<float>(std::clamp(sum / channels, 0.0, 1.0));
  }
  return result;
}

std::vector<glm::vec4> rangeTexels(const CompressedTransfer& transfer) {
  std::vector<glm::vec4> texels;
  for (int l = 0; l < transfer.order; ++l) {
    for (int part = 0; part < 2; ++part) {
      glm::vec4 texel(0.0f);
      for (int c = 0; c < 3; ++c) {
        const int channel = std::min(c, transfer.channels - 1);
        texel[c] = transfer.ranges[static_cast<std::size_t>(channel * transfer.order + l) * 2 + part];
      }
      texels.push_back(part == 1 ? texel * 255.0f : texel);  // OpenGL reads bytes as 0 to 1
    }
  }
  return texels;
}

/// Numbers of a row in whole texels.
constexpr std::size_t paddedLength(std::size_t length) { return (length + 3) / 4 * 4; }

template <typename T>
std::vector<T> paddedRows(std::span<const T> values, std::size_t length) {
  const std::size_t padded = paddedLength(length), rows = values.size() / length;
  std::vector<T> texels(rows * padded, T(0));
  for (std::size_t row = 0; row < rows; ++row) {
    const auto from = values.subspan(row * length, length);
    std::copy(from.begin(), from.end(), texels.begin() + static_cast<std::ptrdiff_t>(row * padded));
  }
  return texels;
}

void bindBuffer(TransferUnit unit, const gl::BufferTexture& buffer) {
  gl::bind(unit, GL_TEXTURE_BUFFER, buffer.texture);
}

}  // namespace

std::vector<float> chBasisTable(const ch::Basis& basis) {
  const int n = basis.order();
  std::vector<float> table(static_cast<std::size_t>(n) * n * n, 0.0f);
  for (int m = 0; m < n; ++m) {
    for (int l = m; l < n; ++l) {
      for (int k = l; k >= m; k -= 2)
        table[(static_cast<std::size_t>(m) * n + l) * n + k] =
            static_cast<float>(basis.shCoefficient(l * (l + 1) + m, k * (k + 1) + m));
    }
  }
  return table;
}

template <typename T>
TransferRows TransferRows::upload(std::span<const T> values, int count, int channels, const char* what) {
  const std::vector<T> texels = paddedRows(values, static_cast<std::size_t>(count));
  return {gl::makeBufferTexture(std::span<const T>(texels), 4, texelFormat<T>(), what), count, channels};
}

void TransferRows::replace(std::size_t firstVertex, std::span<const float> values) const {
  const std::vector<float> padded = paddedRows(values, static_cast<std::size_t>(count));
  const std::size_t vertexLength =
      static_cast<std::size_t>(channels) * paddedLength(static_cast<std::size_t>(count));
  texels.buffer.replace(GL_TEXTURE_BUFFER, firstVertex * vertexLength * sizeof(float),
                        std::span<const float>(padded));
}

HarmonicSeries::HarmonicSeries(const HarmonicTransfer& transfer, Basis basis, const CompiledScene& scene,
                               Attribute result)
    : order_(transfer.order),
      naive_(transfer.naive),
      ofFronts_(result == Attribute::Radiance),
      pass_(scene, result) {
  if (basis == Basis::Ch) {
    ch_.emplace(order_);
    chBasis_ = gl::makeBufferTexture(std::span<const float>(chBasisTable(*ch_)), 1, GL_R32F, "CH basis");
  }
  upload(transfer);
}

void HarmonicSeries::upload(const HarmonicTransfer& transfer) {
  const std::span<const float> values(transfer.coefficients);
  const int count = order_ * order_;
  rows_ = TransferRows::upload(values, count, transfer.channels, "harmonic transfer");
  const std::size_t vertices = values.size() / (static_cast<std::size_t>(count) * transfer.channels);
  const auto accessibility =
      seriesAccessibility(vertices, transfer.channels, evenSky(order_, ch_ ? &*ch_ : nullptr),
                          [&](std::size_t at, std::size_t, std::size_t) { return double(values[at]); });
  accessibility_.emplace(Attribute::Accessibility, std::span<const float>(accessibility));
}

/// In SH; the rest of what it is made for does not depend on the numbers.
bool HarmonicSeries::takeBake(const Bake& bake) {
  if (ch_ || ranges_ || !bake.sh || bake.sh->order != order_) return false;
  upload(*bake.sh);
  return true;
}

HarmonicSeries::HarmonicSeries(const CompressedTransfer& transfer, const CompiledScene& scene)
    : order_(transfer.order), pass_(scene) {
  const int count = order_ * order_;
  const bool bytes = transfer.method == CompressionMethod::Band8;
  if (bytes) {
    rows_ = TransferRows::upload(std::span<const std::uint8_t>(transfer.bytes), count, transfer.channels,
                                 "SH transfer in bytes");
    ranges_ = gl::makeBufferTexture(rangeTexels(transfer), "ranges of bytes");
  } else {
    rows_ = TransferRows::upload(std::span<const std::uint16_t>(transfer.halves), count, transfer.channels,
                                 "SH transfer in halves");
  }
  const auto decode = [&](std::size_t at, std::size_t channel, std::size_t) -> double {
    if (!bytes) return fromHalf(transfer.halves[at]);
    // Only band 0 is asked for: an even sky has no other.
    const float* range = transfer.ranges.data() + channel * static_cast<std::size_t>(order_) * 2;
    return double(range[0]) + double(range[1]) * transfer.bytes[at];
  };
  const auto accessibility =
      seriesAccessibility(transfer.vertexCount, transfer.channels, evenSky(order_, nullptr), decode);
  accessibility_.emplace(Attribute::Accessibility, std::span<const float>(accessibility));
}

/// A sky's numbers in the transfer's basis, [i] RGB.
std::vector<glm::dvec3> HarmonicSeries::inBasis(std::vector<glm::dvec3> sky) const {
  if (!ch_) return sky;
  std::vector<double> channels = byChannel(sky);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = std::span(channels).subspan(c * sky.size(), sky.size());
    ch_->momentsFromSh(channel, channel);
    for (std::size_t i = 0; i < sky.size(); ++i) sky[i][static_cast<int>(c)] = channel[i];
  }
  return sky;
}

/// The light as the shader takes it (techniques/sh/transfer.glsl).
std::vector<glm::vec4> HarmonicSeries::lightTexels(const Illumination& light) const {
  std::vector<glm::vec4> texels;
  for (const auto& sky : {skyCoefficients(light, order_), smoothedCoefficients(light, order_)})
    for (const glm::dvec3& number : inBasis(sky)) texels.emplace_back(number, 0.0);
  return texels;
}

void HarmonicSeries::light(const Illumination& light) {
  light_ = gl::makeBufferTexture(lightTexels(light), "light");
  pass_.run(transferredLights(light), [&](const gl::Program& program) {
    program.set("transferForm", static_cast<int>(TransferForm::Series));
    program.set("transferShape", glm::ivec4(rows_.count, rows_.channels, order_, 1));
    program.set("transferIsCh", ch_ ? 1 : 0);
    program.set("transferHasRanges", ranges_ ? 1 : 0);
    program.set("transferRows", static_cast<int>(ofFronts_ ? TransferRow::Front : TransferRow::Behind));
    bindBuffer(transferUnit, rows_.texels);
    bindBuffer(transferLightUnit, light_);
    if (ranges_) bindBuffer(rangesUnit, *ranges_);
    if (chBasis_) bindBuffer(chBasisUnit, *chBasis_);
  });
}

bool HarmonicSeries::replaceRows(std::size_t firstVertex, std::span<const float> rows) {
  rows_.replace(firstVertex, rows);
  const std::size_t length = static_cast<std::size_t>(rows_.count * rows_.channels);
  const auto accessibility =
      seriesAccessibility(rows.size() / length, rows_.channels, evenSky(order_, ch_ ? &*ch_ : nullptr),
                          [&](std::size_t at, std::size_t, std::size_t) { return double(rows[at]); });
  accessibility_->replace(firstVertex, std::span<const float>(accessibility));
  return true;
}

void HarmonicSeries::bind(const gl::Program&) const {
  if (ofFronts_) accessibility_->attach();
  pass_.attach();
}

void HarmonicSeries::describe(const Illumination&, Warnings& notes) const {
  if (naive_)
    notes.emplace_back(
        "the CH transfer was baked naively, as inner products with functions that are not orthogonal: the "
        "picture shows the resulting error");
}

GroupSeries::GroupSeries(const LightGroupTransfer& transfer, std::vector<int> glow,
                         const CompiledScene& scene)
    : groups_(transfer.groups),
      rows_(TransferRows::upload(std::span<const float>(transfer.coefficients),
                                 static_cast<int>(transfer.groups.size()), transfer.channels,
                                 "light-group transfer")),
      groupOfGlow_(std::move(glow)),
      glow_(groupOfGlow_.size(), glm::vec3(1.0f)),
      glowStream_(Attribute::Glow, std::span<const glm::vec3>(glow_)),
      pass_(scene) {}

void GroupSeries::light(const Illumination& light) {
  const auto factor = [&](std::size_t group) {
    return group < light.groupFactors.size() ? light.groupFactors[group] : glm::vec3(1.0f);
  };
  std::vector<glm::vec4> texels;
  for (std::size_t g = 0; g < groups_.size(); ++g) texels.emplace_back(groups_[g].color * factor(g), 0.0f);
  light_ = gl::makeBufferTexture(texels, "colours of light groups");
  for (std::size_t v = 0; v < glow_.size(); ++v)
    glow_[v] = groupOfGlow_[v] < 0 ? glm::vec3(1.0f) : factor(static_cast<std::size_t>(groupOfGlow_[v]));
  glowStream_.fill(std::span<const glm::vec3>(glow_));
  pass_.run({}, [&](const gl::Program& program) {
    program.set("transferForm", static_cast<int>(TransferForm::Series));
    program.set("transferShape", glm::ivec4(rows_.count, rows_.channels, 0, 0));
    program.set("transferIsCh", 0);
    program.set("transferHasRanges", 0);
    bindBuffer(transferUnit, rows_.texels);
    bindBuffer(transferLightUnit, light_);
  });
}

void GroupSeries::bind(const gl::Program&) const {
  glVertexAttrib1f(static_cast<GLuint>(Attribute::Accessibility), 0.0f);  // light of groups is not the sky's
  glowStream_.attach();
  pass_.attach();
}

void GroupSeries::describe(const Illumination& light, Warnings& notes) const {
  if (light.skyMap != nullptr)
    notes.emplace_back(
        "in lights shading the sky is seen, but lights nothing and is reflected only where the bake has "
        "ambient occlusion: light groups hold the scene's own lights");
}

std::vector<int> glowGroups(const LightGroupTransfer& transfer, const CompiledScene& scene) {
  std::vector<int> result(scene.vertexCount(), -1);
  for (const PrimitiveRange& range : scene.primitives) {
    const std::string name = range.name.empty() ? "node " + std::to_string(range.node) : range.name;
    const auto found = std::find_if(transfer.groups.begin(), transfer.groups.end(),
                                    [&](const LightGroup& group) { return group.name == name; });
    if (found == transfer.groups.end()) continue;
    const auto first = result.begin() + static_cast<std::ptrdiff_t>(range.firstVertex);
    std::fill(first, first + static_cast<std::ptrdiff_t>(range.vertexCount),
              static_cast<int>(found - transfer.groups.begin()));
  }
  return result;
}

}  // namespace prelight::viewer
