#include <array>
#include <cmath>

#include "benchmarks/suites/stability/cases.h"
#include "compress/compression_error.h"
#include "compress/small_floats.h"
#include "oracle/relighting.h"
#include "relight/device/cluster_relighter.h"
#include "relight/device/compressed_light.h"
#include "relight/device/dense_relighter.h"
#include "relight/device/keyframe_relighter.h"
#include "techniques/glossy/glossy_relighter.h"
#include "techniques/haar/haar_relighter.h"

namespace prelight::benchmarks::stability {

namespace {

using Colors = std::vector<glm::dvec3>;

constexpr std::size_t vertices = 37;  ///< not a whole number of tiles

/// Magnitudes of transfer and of light.
struct Magnitudes {
  const char* stress;
  double transfer;
  double light;
  bool oneSign;  ///< nothing cancels, so that rounding errors add up
};

constexpr std::array<Magnitudes, 6> magnitudes = {{{"random numbers, whose sums cancel", 1.0, 1.0, false},
                                                   {"one sign", 1.0, 1.0, true},
                                                   {"light of 1e6", 1.0, 1e6, true},
                                                   {"light of 1e-6", 1.0, 1e-6, false},
                                                   {"transfer of 1e-30, light of 1e30", 1e-30, 1e30, true},
                                                   {"denormal transfer", 1e-40, 1.0, false}}};

std::vector<float> numbers(std::size_t count, double scale, bool oneSign, std::uint32_t seed) {
  std::vector<float> values = Random(seed).floats(count, scale);
  if (oneSign)
    for (float& value : values) value = std::abs(value);
  return values;
}

std::vector<double> lightOf(std::size_t count, const Magnitudes& m) {
  const std::vector<float> values = numbers(3 * count, m.light, m.oneSign, 99);
  return {values.begin(), values.end()};
}

/// Returns sums of the magnitudes of the terms, to which errors are relative.
template <typename Values>
Values magnitudesOf(Values values) {
  for (auto& value : values) value = std::abs(value);
  return values;
}

void compare(const std::vector<float>& got, const Colors& truth, const Colors& scale,
             Differences& differences) {
  for (std::size_t v = 0; v < truth.size(); ++v)
    for (int c = 0; c < 3; ++c)
      differences.add(got[3 * v + static_cast<std::size_t>(c)], truth[v][c], scale[v][c]);
}

template <typename Relighter>
std::vector<float> radianceOf(Relighter& relighter, DeviceContext& device) {
  Buffer<float> radiance(device, 3 * vertices);
  relighter.relight(radiance);
  return radiance.read();
}

HarmonicTransfer transferOf(int order, int channels, const Magnitudes& m, std::uint32_t seed) {
  return {
      order, channels, 0,
      numbers(vertices * static_cast<std::size_t>(channels * order * order), m.transfer, m.oneSign, seed)};
}

void relightFloats(const Magnitudes& m, int order, int channels, Trials& trials) {
  const HarmonicTransfer transfer = transferOf(order, channels, m, 1);
  const std::vector<double> light = lightOf(static_cast<std::size_t>(order * order), m);
  DenseRelighter relighter(trials.context(), transfer);
  relighter.setLight(light);
  HarmonicTransfer sizes = transfer;
  sizes.coefficients = magnitudesOf(sizes.coefficients);
  Differences differences;
  compare(radianceOf(relighter, trials.context()), relight(transfer, light),
          relight(sizes, magnitudesOf(light)), differences);
  trials.record(std::string(m.stress) + (channels == 1 ? ", one channel" : ""), differences,
                sumBound(order * order + 2.0), {"order", double(order)});
}

/// Measures halves and bytes. The truth uses the stored values, so that errors of storage do not count.
void relightStored(const Magnitudes& m, const char* method, Trials& trials) {
  const HarmonicTransfer transfer = transferOf(6, 3, m, 2);
  const CompressedTransfer stored = compress(transfer, parseCompression(method));
  const HarmonicTransfer restored = decompress(stored);
  const std::vector<double> light = lightOf(36, m);
  DenseRelighter relighter(trials.context(), stored);
  relighter.setLight(light);
  HarmonicTransfer sizes = restored;
  for (std::size_t i = 0; i < sizes.coefficients.size(); ++i) {
    // Offset and scale x byte are summed separately.
    const std::size_t channel = i / 36 % 3, band = static_cast<std::size_t>(std::sqrt(double(i % 36) + 0.5));
    const double offset =
        stored.ranges.empty() ? 0.0 : std::abs(double(stored.ranges[2 * (channel * 6 + band)]));
    sizes.coefficients[i] = static_cast<float>(std::abs(double(restored.coefficients[i])) + 2.0 * offset);
  }
  // `restored` is rounded to float once more.
  Differences differences;
  compare(radianceOf(relighter, trials.context()), relight(restored, light),
          relight(sizes, magnitudesOf(light)), differences);
  trials.record(std::string(m.stress) + ", " + method, differences, sumBound(36.0 + 6.0));
}

/// Measures every finite half, including denormal ones, through a transfer of one coefficient.
void relightEveryHalf(Trials& trials) {
  CompressedTransfer stored;
  stored.method = CompressionMethod::Half;
  stored.order = 1;
  stored.channels = 1;
  for (std::uint32_t bits = 0; bits < 0x10000u; ++bits)
    if ((bits & 0x7c00u) != 0x7c00u) stored.halves.push_back(static_cast<std::uint16_t>(bits));
  stored.vertexCount = static_cast<std::uint32_t>(stored.halves.size());
  DenseRelighter relighter(trials.context(), stored);
  relighter.setLight(std::vector<double>{1.0, 1e6, 1e-6});
  Buffer<float> radiance(trials.context(), 3 * stored.halves.size());
  relighter.relight(radiance);
  const std::vector<float> got = radiance.read();
  Differences differences;
  for (std::size_t v = 0; v < stored.halves.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint16_t bits = stored.halves[v];
      const int exponent = bits >> 10 & 31;
      const double size =
          exponent == 0 ? std::ldexp(bits & 1023, -24) : std::ldexp(1024 + (bits & 1023), exponent - 25);
      const std::array<double, 3> lights{1.0, 1e6, double(1e-6f)};
      const double truth = ((bits & 0x8000) != 0 ? -size : size) * lights[c];
      differences.add(got[3 * v + c], truth);
    }
  trials.record("every finite half", differences, 2.0 * unitRoundoff);
}

void relightKeys(const Magnitudes& m, int order, Trials& trials) {
  const std::vector<HarmonicTransfer> keys = {transferOf(order, 3, m, 5), transferOf(order, 3, m, 6)};
  const std::vector<double> light = lightOf(static_cast<std::size_t>(order * order), m);
  KeyframeRelighter relighter(trials.context(), keys);
  relighter.setLight(light);
  Colors truth = relight(keys[0], light), scale(vertices, glm::dvec3(0.0));
  const Colors after = relight(keys[1], light);
  constexpr double blend = 0.3125;
  for (std::size_t v = 0; v < vertices; ++v) truth[v] += blend * (after[v] - truth[v]);
  for (HarmonicTransfer sizes : keys) {
    sizes.coefficients = magnitudesOf(sizes.coefficients);
    const Colors part = relight(sizes, magnitudesOf(light));
    for (std::size_t v = 0; v < vertices; ++v) scale[v] += part[v];
  }
  Buffer<float> radiance(trials.context(), 3 * vertices);
  relighter.setMoment(0, blend);
  relighter.relight(radiance);
  Differences differences;
  compare(radiance.read(), truth, scale, differences);
  trials.record(m.stress, differences, sumBound(order * order + 4.0), {"order", double(order)});
}

CompressedTransfer clustersOf(int components, WeightStorage storage, const Magnitudes& m) {
  CompressedTransfer out;
  out.method = components == 0 ? CompressionMethod::Vq : CompressionMethod::Cpca;
  out.order = 4;
  out.channels = 3;
  out.vertexCount = vertices;
  out.clusters = 5;
  out.components = components;
  out.weights = storage;
  out.means = numbers(5 * 48, m.transfer, m.oneSign, 2);
  out.basis = numbers(static_cast<std::size_t>(5 * components) * 48, m.transfer, m.oneSign, 3);
  Random random(4);
  const std::size_t count = vertices * static_cast<std::size_t>(components);
  for (std::size_t v = 0; v < vertices; ++v)
    out.clusterOf.push_back(static_cast<std::uint16_t>(random.bits() % 5));
  for (std::size_t i = 0; i < count; ++i) {
    const float weight = static_cast<float>(random.between(m.oneSign ? 0.0 : -4.0, 4.0));
    if (storage == WeightStorage::Float) out.weightFloats.push_back(weight);
    if (storage == WeightStorage::Half) out.weightHalves.push_back(toHalf(weight));
    if (storage == WeightStorage::Byte) out.weightBytes.push_back(static_cast<std::uint8_t>(random.bits()));
  }
  if (storage == WeightStorage::Byte)
    for (int i = 0; i < 5 * components; ++i) {
      out.weightRanges.push_back(static_cast<float>(random.between(-1.0, 1.0)));
      out.weightRanges.push_back(static_cast<float>(random.between(0.0, 0.01)));
    }
  return out;
}

void relightClusters(const Magnitudes& m, int components, WeightStorage storage, const char* how,
                     Trials& trials) {
  const CompressedTransfer stored = clustersOf(components, storage, m);
  const std::vector<double> light = lightOf(16, m);
  ClusterRelighter relighter(trials.context(), stored);
  relighter.setLight(light);
  const CompressedLight terms = prelight::lightOf(stored, light);
  const Colors truth = relight(stored, terms);
  Colors scale;
  const auto width = static_cast<std::size_t>(1 + components);
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::size_t first = stored.cluster(v) * width;
    glm::dvec3 sum = glm::abs(glm::dvec3(terms.terms[first]));
    for (std::size_t j = 0; j + 1 < width; ++j) {
      // With bytes the terms include the range.
      const double weight =
          storage == WeightStorage::Byte ? stored.weightBytes[v * (width - 1) + j] : stored.weight(v, j);
      sum += std::abs(weight) * glm::abs(glm::dvec3(terms.terms[first + 1 + j]));
    }
    scale.push_back(sum);
  }
  Differences differences;
  compare(radianceOf(relighter, trials.context()), truth, scale, differences);
  trials.record(std::string(m.stress) + ", " + how, differences, sumBound(components + 2.0),
                {"components", double(components)});
}

HaarTransfer rowsOf(int faceSize, int channels, const Magnitudes& m) {
  HaarTransfer transfer;
  transfer.faceSize = faceSize;
  transfer.channels = channels;
  transfer.offsets = {0};
  Random random(8);
  const auto texels = static_cast<std::uint32_t>(6 * faceSize * faceSize);
  for (std::size_t row = 0; row < vertices * static_cast<std::size_t>(channels); ++row) {
    for (std::uint32_t i = 0; i < texels; ++i)
      if (random.bits() % 2 == 0) {
        transfer.indices.push_back(i);
        transfer.values.push_back(
            static_cast<float>(random.between(m.oneSign ? 0.0 : -m.transfer, m.transfer)));
      }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.indices.size()));
  }
  return transfer;
}

void relightWavelets(const Magnitudes& m, int faceSize, HaarForm form, int channels, Trials& trials) {
  const HaarTransfer transfer = rowsOf(faceSize, channels, m);
  const auto texels = static_cast<std::uint32_t>(6 * faceSize * faceSize);
  const std::vector<double> light = lightOf(texels, m);
  std::vector<haar::LitWavelet> lit, sizes;
  for (std::uint32_t i = 0; i < texels; ++i) {
    lit.push_back({i, {light[i], light[texels + i], light[2 * texels + i]}});
    sizes.push_back({i, glm::abs(lit.back().color)});
  }
  HaarTransfer magnitude = transfer;
  magnitude.values = magnitudesOf(magnitude.values);
  HaarRelighter relighter(trials.context(), transfer, form);
  relighter.setLight(lit);
  Differences differences;
  compare(radianceOf(relighter, trials.context()), reference::relightHaar(transfer, lit),
          reference::relightHaar(magnitude, sizes), differences);
  trials.record(std::string(m.stress) + (form == HaarForm::Rows ? ", rows" : ", columns"), differences,
                sumBound(texels), {"texels per side", double(faceSize)});
}

void lightGlossy(const Magnitudes& m, int order, int channels, Trials& trials) {
  const auto n = static_cast<std::size_t>(order * order);
  const GlossyTransfer transfer{
      order, channels, 0,
      numbers(vertices * static_cast<std::size_t>(channels) * n * n, m.transfer, m.oneSign, 10)};
  const std::vector<double> light = lightOf(n, m);
  GlossyRelighter relighter(trials.context(), transfer);
  relighter.light(light);
  GlossyTransfer sizes = transfer;
  sizes.matrices = magnitudesOf(sizes.matrices);
  const std::vector<float> arriving = relighter.arriving();
  const std::vector<double> truth = reference::lightMatrices(transfer, light),
                            scale = reference::lightMatrices(sizes, magnitudesOf(light));
  Differences differences;
  for (std::size_t i = 0; i < truth.size(); ++i) differences.add(arriving[i], truth[i], scale[i]);
  trials.record(std::string(m.stress) + ", matrices", differences, sumBound(double(n) + 2.0),
                {"order", double(order)});

  // The truth of lobes uses the matrices of the device, so that errors of matrices do not count again.
  Random random(11);
  Colors directions;
  std::vector<float> flat;
  for (std::size_t v = 0; v < vertices; ++v) {
    const glm::vec3 d(v == 0 ? glm::dvec3(0, 0, 1) : v == 1 ? glm::dvec3(0, 1, 0) : random.direction());
    directions.push_back(glm::normalize(glm::dvec3(d)));
    flat.insert(flat.end(), {d.x, d.y, d.z});
  }
  std::vector<double> lobe;
  for (int l = 0; l < order; ++l) lobe.push_back(1.0 / (1.0 + l));
  Buffer<float> directionBuffer(trials.context(), std::span<const float>(flat)),
      radiance(trials.context(), 3 * vertices);
  relighter.shade(directionBuffer, lobe, radiance);
  const std::vector<double> held(arriving.begin(), arriving.end());
  Colors lobeScale(vertices, glm::dvec3(0.0));
  for (std::size_t v = 0; v < vertices; ++v)
    for (int c = 0; c < 3; ++c)
      for (int l = 0; l < order; ++l)
        for (int k = l * l; k < (l + 1) * (l + 1); ++k)
          lobeScale[v][c] +=
              lobe[static_cast<std::size_t>(l)] * std::sqrt((2 * l + 1) / 12.566370614359172) *
              std::abs(held[(v * 3 + static_cast<std::size_t>(c)) * n + static_cast<std::size_t>(k)]);
  Differences lobes;
  compare(radiance.read(), reference::shadeGlossy(held, order, directions, lobe), lobeScale, lobes);
  trials.record(std::string(m.stress) + ", lobes", lobes, 16.0 * order * unitRoundoff,
                {"order", double(order)});
}

}  // namespace

void runDense(Trials& trials) {
  for (const Magnitudes& m : magnitudes)
    for (const int order : trials.options().orders) {
      relightFloats(m, order, 3, trials);
      if (order <= 3) relightFloats(m, order, 1, trials);
    }
  for (const Magnitudes& m : magnitudes)
    if (m.transfer == 1.0)
      for (const char* method : {"half", "band8"}) relightStored(m, method, trials);
  relightEveryHalf(trials);
}

void runKeys(Trials& trials) {
  for (const Magnitudes& m : magnitudes)
    for (const int order : trials.options().orders)
      if (order <= 8) relightKeys(m, order, trials);
}

void runClusters(Trials& trials) {
  for (const Magnitudes& m : magnitudes)
    for (const int components : {0, 3, 8, 24}) {
      relightClusters(m, components, WeightStorage::Half, "halves", trials);
      if (components == 8) {
        relightClusters(m, components, WeightStorage::Float, "floats", trials);
        relightClusters(m, components, WeightStorage::Byte, "bytes", trials);
      }
    }
}

void runHaarRows(Trials& trials) {
  for (const Magnitudes& m : magnitudes)
    for (const int size : trials.options().faceSizes)
      if (size <= 32)
        for (const HaarForm form : {HaarForm::Rows, HaarForm::Columns})
          relightWavelets(m, size, form, form == HaarForm::Rows ? 3 : 1, trials);
}

void runGlossy(Trials& trials) {
  for (const Magnitudes& m : magnitudes)
    for (const int order : trials.options().orders)
      if (order <= 8) lightGlossy(m, order, order % 2 == 0 ? 3 : 1, trials);
}

}  // namespace prelight::benchmarks::stability
