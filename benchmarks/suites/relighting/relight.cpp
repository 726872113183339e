#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "basis/cube_map.h"
#include "basis/haar.h"
#include "basis/sh.h"
#include "basis/sh_rotation.h"
#include "benchmarks/lab/lab_kernels.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/suites/relighting/relighting_suite.h"
#include "compress/compression_error.h"
#include "device/kernel.h"
#include "oracle/relighting.h"
#include "prelight/device.h"
#include "prelight/relighter.h"
#include "relight/device/band_rotator.h"
#include "relight/device/compressed_light.h"
#include "techniques/glossy/glossy_relighter.h"
#include "techniques/haar/haar_relighter.h"

namespace prelight::benchmarks {

namespace {

/// One kind of relighting of random transfer, ready to run.
struct RelightCase {
  std::string name;
  std::size_t items = 0;      ///< vertices, or texels of a sky
  std::size_t bytes = 0;      ///< bytes read and written per run
  double error = 0.0;         ///< relative RMS error against the reference in double precision
  std::function<void()> run;  ///< launches and waits
};

using Floats = std::vector<float>;
using Colors = std::vector<glm::dvec3>;

/// Returns random transfer: memory traffic does not depend on values, and errors are relative.
Floats randomFloats(std::size_t count, unsigned seed) {
  std::minstd_rand random(seed);
  Floats values(count);
  for (float& value : values) value = static_cast<float>(random()) * 0x1p-30f - 1.0f;
  return values;
}

std::vector<double> randomLight(std::size_t count) {
  const Floats values = randomFloats(3 * count, 99);
  return {values.begin(), values.end()};
}

HarmonicTransfer randomTransfer(std::size_t vertices, int order, int channels, unsigned seed) {
  return {order, channels, 0,
          randomFloats(vertices * static_cast<std::size_t>(channels * order * order), seed)};
}

template <typename Got, typename Right>
double relativeError(std::size_t count, const Got& got, const Right& right) {
  double squares = 0.0, of = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double difference = double(got(i)) - double(right(i));
    squares += difference * difference;
    of += double(right(i)) * double(right(i));
  }
  return of > 0.0 ? std::sqrt(squares / of) : 0.0;
}

double relativeError(const Floats& got, const Colors& right) {
  return relativeError(
      3 * right.size(), [&](std::size_t i) { return got[i]; },
      [&](std::size_t i) { return right[i / 3][static_cast<int>(i % 3)]; });
}

double relativeError(const Floats& got, const std::vector<double>& right) {
  return relativeError(
      right.size(), [&](std::size_t i) { return got[i]; }, [&](std::size_t i) { return right[i]; });
}

/// How often a relighter's result leaves the device.
enum class Reading { None, EveryTime };

/// Returns the case of a bake under a light, by the library's Relighter; `right` is radiance before albedo.
RelightCase caseOf(const std::string& name, const Device& device, const Bake& bake,
                   const RelighterLight& light, const Colors& right, Reading reading = Reading::None,
                   double time = 0.0) {
  auto relighter = std::make_shared<Relighter>(bake, device);
  relighter->light(light);
  if (bake.animation) relighter->setTime(time);
  auto radiance = std::make_shared<std::vector<glm::vec3>>(relighter->receiverCount());
  relighter->relight(*radiance);
  Floats got;
  for (const glm::vec3& color : *radiance) got.insert(got.end(), {color.x, color.y, color.z});
  RelightCase made{name, relighter->receiverCount(), relighter->bytesMoved(), relativeError(got, right), {}};
  if (reading == Reading::EveryTime)
    made.run = [relighter, radiance] { relighter->relight(*radiance); };
  else
    made.run = [&context = device.context(), relighter] {
      relighter->relight();
      context.finish();
    };
  return made;
}

/// Returns the case of a relighter of a technique whose relight(radiance) does the work.
template <typename TechniqueRelighter>
RelightCase caseOf(const std::string& name, DeviceContext& device,
                   std::shared_ptr<TechniqueRelighter> relighter, const Colors& right) {
  auto radiance = std::make_shared<Buffer<float>>(device, 3 * relighter->vertexCount());
  relighter->relight(*radiance);
  const double error = relativeError(radiance->read(), right);
  return {name, relighter->vertexCount(), relighter->bytesMoved(), error, [&device, relighter, radiance] {
            relighter->relight(*radiance);
            device.finish();
          }};
}

void addDense(const Device& device, std::size_t vertices, std::vector<RelightCase>& cases) {
  const auto light = randomLight(36);
  for (const int channels : {3, 1}) {
    Bake bake;
    bake.sh = randomTransfer(vertices, 6, channels, 1);
    const Colors right = relight(*bake.sh, light);
    const std::string name = fmt::format("dense, {} channel{}", channels, channels == 1 ? "" : "s");
    cases.push_back(caseOf(name, device, bake, {.coefficients = light}, right));
    if (channels == 1) continue;
    cases.push_back(
        caseOf(name + ", read back", device, bake, {.coefficients = light}, right, Reading::EveryTime));
    for (const char* method : {"half", "band8"}) {
      Bake smaller;
      smaller.compressedSh = compress(*bake.sh, parseCompression(method));
      cases.push_back(caseOf(method, device, smaller, {.coefficients = light},
                             relight(decompress(*smaller.compressedSh), light)));
    }
  }
}

/// Returns clusters as compress() makes them, but from random numbers, since finding clusters is not
/// measured.
CompressedTransfer randomClusters(std::size_t vertices, int clusters, int components) {
  CompressedTransfer out;
  out.method = components == 0 ? CompressionMethod::Vq : CompressionMethod::Cpca;
  out.order = 6;
  out.channels = 3;
  out.vertexCount = static_cast<std::uint32_t>(vertices);
  out.clusters = clusters;
  out.components = components;
  out.means = randomFloats(static_cast<std::size_t>(clusters) * 108, 2);
  out.basis = randomFloats(static_cast<std::size_t>(clusters * components) * 108, 3);
  std::minstd_rand random(4);
  for (std::size_t v = 0; v < vertices; ++v)  // neighbours often share a cluster
    out.clusterOf.push_back(
        static_cast<std::uint16_t>((v * static_cast<std::size_t>(clusters) / vertices + random() % 3) %
                                   static_cast<std::size_t>(clusters)));
  for (std::size_t i = 0; i < vertices * static_cast<std::size_t>(components); ++i)
    out.weightHalves.push_back(static_cast<std::uint16_t>(0x3000u + random() % 0xc00u));
  return out;
}

void addClustered(const Device& device, std::size_t vertices, std::vector<RelightCase>& cases) {
  const auto light = randomLight(36);
  for (const int components : {8, 0}) {
    Bake bake;
    bake.compressedSh = randomClusters(vertices, 64, components);
    cases.push_back(caseOf(components == 0 ? "vq:64" : "cpca:64:8", device, bake, {.coefficients = light},
                           relight(*bake.compressedSh, lightOf(*bake.compressedSh, light))));
  }
}

void addKeys(const Device& device, std::size_t vertices, std::vector<RelightCase>& cases) {
  const auto light = randomLight(36);
  Bake bake;
  bake.animation = AnimatedTransfer{
      .times = {0.0, 1.0}, .keys = {randomTransfer(vertices, 6, 3, 5), randomTransfer(vertices, 6, 3, 6)}};
  Colors right = relight(bake.animation->keys[0], light);
  const Colors after = relight(bake.animation->keys[1], light);
  for (std::size_t v = 0; v < right.size(); ++v) right[v] += 0.25 * (after[v] - right[v]);
  cases.push_back(caseOf("two keys", device, bake, {.coefficients = light}, right, Reading::None, 0.25));
}

void addGroups(const Device& device, std::size_t vertices, std::vector<RelightCase>& cases) {
  LightGroupTransfer groups;
  for (int g = 0; g < 8; ++g) groups.groups.push_back({fmt::format("group {}", g)});
  groups.channels = 3;
  groups.coefficients = randomFloats(vertices * 24, 7);
  const Floats numbers = randomFloats(24, 99);
  std::vector<glm::vec3> colors;
  for (std::size_t g = 0; g < 8; ++g) colors.emplace_back(numbers[g], numbers[8 + g], numbers[16 + g]);
  const Colors right = reference::relightGroups(groups, Colors(colors.begin(), colors.end()));
  Bake bake;
  bake.lightGroups = std::move(groups);
  cases.push_back(caseOf("8 light groups", device, bake, {.groups = colors}, right));
}

/// Returns rows whose coefficients get sparser from coarse to fine, as in real transfer: about 1,100 of 6 x
/// 32 x 32.
HaarTransfer randomHaar(std::size_t vertices) {
  constexpr int faceSize = 32;
  HaarTransfer transfer;
  transfer.faceSize = faceSize;
  transfer.offsets = {0};
  std::minstd_rand random(8);
  for (std::size_t v = 0; v < vertices; ++v) {
    for (std::uint32_t i = 0; i < 6 * faceSize * faceSize; ++i) {
      const int size = haar::waveletOf(i, faceSize).size;
      if (random() % 16 < static_cast<unsigned>(std::min(16, size))) {
        transfer.indices.push_back(i);
        transfer.values.push_back(static_cast<float>(random()) * 0x1p-30f - 1.0f);
      }
    }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.indices.size()));
  }
  return transfer;
}

void addHaar(DeviceContext& device, std::size_t vertices, std::vector<RelightCase>& cases) {
  const HaarTransfer transfer = randomHaar(vertices);
  std::vector<haar::LitWavelet> light;
  std::minstd_rand random(9);
  for (int k = 0; k < 100; ++k) {  // half of them coarse, half at any level
    const auto place = static_cast<std::uint32_t>(random());
    const std::uint32_t coarse = place % 6 * 1024 + (place >> 4) % 8 * 4 * 32 + (place >> 8) % 8 * 4;
    light.push_back({k % 2 == 0 ? coarse : place % 6144, {1.0f, 0.5f, -0.25f}});
  }
  const Colors right = reference::relightHaar(transfer, light);
  for (const HaarForm form : {HaarForm::Columns, HaarForm::Rows}) {
    auto relighter = std::make_shared<HaarRelighter>(device, transfer, form);
    relighter->setLight(light);
    cases.push_back(caseOf(form == HaarForm::Columns ? "Haar, lit columns" : "Haar, whole rows", device,
                           relighter, right));
  }
}

void addGlossy(DeviceContext& device, std::size_t vertices, std::vector<RelightCase>& cases) {
  constexpr int order = 4;
  const std::size_t fewer =
      std::max<std::size_t>(1, vertices / 4);  // a matrix has 7 times the size of a vector
  const GlossyTransfer transfer{order, 3, 0, randomFloats(fewer * 3 * 256, 10)};
  const auto light = randomLight(16);
  const auto arriving = reference::lightMatrices(transfer, light);
  auto relighter = std::make_shared<GlossyRelighter>(device, transfer);
  relighter->light(light);
  cases.push_back({"glossy matrices, order 4", fewer, relighter->bytesMoved(),
                   relativeError(relighter->arriving(), arriving), [&device, relighter, light] {
                     relighter->light(light);
                     device.finish();
                   }});
  std::vector<glm::dvec3> directions;
  Floats flat;
  const Floats numbers = randomFloats(3 * fewer, 11);
  for (std::size_t v = 0; v < fewer; ++v) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(numbers[3 * v], numbers[3 * v + 1], numbers[3 * v + 2]));
    directions.push_back(d);
    for (int axis = 0; axis < 3; ++axis) flat.push_back(static_cast<float>(d[axis]));
  }
  const std::vector<double> lobe = {1.0, 0.8, 0.5, 0.3};
  auto directionBuffer = std::make_shared<Buffer<float>>(device, std::span<const float>(flat));
  auto radiance = std::make_shared<Buffer<float>>(device, 3 * fewer);
  const auto shade = [&device, relighter, directionBuffer, radiance, lobe] {
    relighter->shade(*directionBuffer, lobe, *radiance);
    device.finish();
  };
  shade();
  cases.push_back({"glossy lobes, order 4", fewer, fewer * (48 + 3 + 3) * sizeof(float),
                   relativeError(radiance->read(), reference::shadeGlossy(arriving, order, directions, lobe)),
                   shade});
}

Environment randomSky(int rows) {
  Environment sky{2 * rows, rows, {}};
  const Floats values = randomFloats(static_cast<std::size_t>(6 * rows * rows), 12);
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    sky.radiance.emplace_back(1.0f + values[i], 1.0f + values[i + 1], 1.0f + values[i + 2]);
  return sky;
}

void addRotation(DeviceContext& device, std::vector<RelightCase>& cases) {
  constexpr int order = 6;
  constexpr std::size_t functions = 3000, n = 36;
  auto rotator = std::make_shared<BandRotator>(device, order);
  const glm::dmat3 turn{{0.0, 0.6, 0.8}, {1.0, 0.0, 0.0}, {0.0, 0.8, -0.6}};
  rotator->setRotation(turn);
  const Floats values = randomFloats(functions * n, 13);
  auto in = std::make_shared<Buffer<float>>(device, std::span<const float>(values));
  auto out = std::make_shared<Buffer<float>>(device, functions * n);
  const auto run = [&device, rotator, in, out] {
    rotator->rotate(*in, *out, functions);
    device.finish();
  };
  run();
  std::vector<double> right(values.begin(), values.end());
  sh::ShRotation(order, turn).apply(right, right);
  cases.push_back({"SH rotation, order 6, 3000 functions", functions, 2 * functions * n * sizeof(float),
                   relativeError(out->read(), right), run});
}

/// Returns dense, compressed, clustered, keyed, light-group, Haar and glossy relighting of `vertices`
/// vertices.
std::vector<RelightCase> transferCases(const Device& device, std::size_t vertices) {
  std::vector<RelightCase> cases;
  addDense(device, vertices, cases);
  addClustered(device, vertices, cases);
  addKeys(device, vertices, cases);
  addGroups(device, vertices, cases);
  addHaar(device.context(), std::max<std::size_t>(1, vertices / 10), cases);
  addGlossy(device.context(), vertices, cases);
  return cases;
}

/// Returns projection of a sky of `rows` rows onto SH and Haar, and rotation of its coefficients.
std::vector<RelightCase> lightCases(const Device& device, int rows) {
  std::vector<RelightCase> cases;
  const Environment sky = randomSky(rows);
  const std::size_t texels = sky.radiance.size();
  for (const int order : {6, 32}) {
    auto projector = std::make_shared<SkyProjector>(device, sky.width, sky.height, order);
    projector->setSky(sky);
    const std::vector<double> found = projector->projectSh();
    cases.push_back({fmt::format("sky to SH, order {}", order), texels, texels * 3 * sizeof(float),
                     relativeError({found.begin(), found.end()}, sh::projectEnvironment(sky, order)),
                     [projector] { projector->projectSh(); }});
  }
  auto projector = std::make_shared<SkyProjector>(device, sky.width, sky.height, 1);
  projector->setSky(sky);
  const int faceSize = std::max(4, rows / 8);
  const std::vector<float> got = projector->projectWavelets(faceSize, 8);
  const CubeMap cube = cubeFromEnvironment(sky, faceSize);
  std::vector<double> right(cubeTexelCount(faceSize));
  for (std::size_t i = 0; i < right.size(); ++i) right[i] = double(cube.radiance[i].x);
  haar::forward(std::span<double>(right), faceSize);
  cases.push_back({fmt::format("sky to Haar, 6 x {0} x {0}", faceSize), cubeTexelCount(faceSize),
                   texels * 3 * sizeof(float) + cubeTexelCount(faceSize) * 3 * sizeof(float),
                   relativeError(got, right),
                   [projector, faceSize] { projector->projectWavelets(faceSize, 8); }});
  addRotation(device.context(), cases);
  return cases;
}

/// Copies as many bytes as the largest transfer holds by a trivial kernel, which shows the machine's memory
/// bandwidth.
class DeviceCopy {
 public:
  DeviceCopy(DeviceContext& device, std::size_t bytes)
      : device_(device),
        lines_(bytes / (16 * sizeof(float))),
        in_(device, lines_ * 16),
        out_(device, lines_ * 16),
        kernel_(device, labKernel(device, "copy_kernels.cl"), {}, "copyLanes") {
    in_.fill(1.0f);
  }

  std::size_t bytesMoved() const { return 2 * in_.bytes(); }

  void run() {
    kernel_.launch(lines_, in_, static_cast<std::uint32_t>(lines_), out_);
    device_.finish();
  }

 private:
  DeviceContext& device_;
  std::size_t lines_;
  Buffer<float> in_, out_;
  Kernel<Buffer<float>, std::uint32_t, Buffer<float>> kernel_;
};

/// Copies by memcpy on all cores.
class HostCopy {
 public:
  explicit HostCopy(std::size_t bytes) : in_(bytes, 1), out_(bytes) {}

  std::size_t bytesMoved() const { return 2 * in_.size(); }

  void run() {
    const std::size_t grain = (in_.size() + hardwareThreads() - 1) / hardwareThreads();
    parallelRanges(in_.size(), grain, [&](std::size_t begin, std::size_t end) {
      std::memcpy(out_.data() + begin, in_.data() + begin, end - begin);
    });
  }

 private:
  std::vector<char> in_, out_;
};

}  // namespace

void runRelight(const Device& device, const RelightingOptions& options, SuiteRun& run) {
  std::vector<RelightCase> cases = transferCases(device, options.relightVertices);
  for (RelightCase& light : lightCases(device, options.relightSkyRows)) cases.push_back(std::move(light));
  DeviceCopy deviceCopy(device.context(), options.relightVertices * 108 * sizeof(float));
  HostCopy hostCopy(options.relightVertices * 108 * sizeof(float));
  run.report("bench relight", 0.0);

  std::vector<Contender> contenders;
  for (const RelightCase& one : cases) contenders.push_back({one.name, [&one](std::size_t) { one.run(); }});
  contenders.push_back({"copy", [&](std::size_t) { deviceCopy.run(); }});
  contenders.push_back({"memcpy", [&](std::size_t) { hostCopy.run(); }});
  takeTurns(contenders, 1, options.relightRounds, run);
  run.report("bench relight", 1.0);

  const Contender& copy = contenders[cases.size()];
  std::vector<BenchmarkResult>& results = run.results();
  const auto add = [&](const Contender& own, std::size_t bytes) {
    const double byteRatio = double(bytes) / double(deviceCopy.bytesMoved());
    results.push_back({own.name, "bandwidth", double(bytes) / medianSeconds(own.seconds, 1), "B/s", "copy",
                       medianRatio(own.seconds, copy.seconds) * byteRatio});
    // Bytes per second of processor time, which other programs do not disturb.
    results.push_back({own.name, "bandwidth per core", double(bytes) / median(own.cpuSeconds), "B/s", "copy",
                       medianRatio(own.cpuSeconds, copy.cpuSeconds) * byteRatio});
  };
  add(copy, deviceCopy.bytesMoved());
  add(contenders.back(), hostCopy.bytesMoved());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    add(contenders[i], cases[i].bytes);
    results.push_back({cases[i].name,
                       "rate",
                       double(cases[i].items) / medianSeconds(contenders[i].seconds, 1),
                       "items/s",
                       {},
                       {}});
    results.push_back({cases[i].name, "relative error", cases[i].error, "1", {}, {}});
  }
}

}  // namespace prelight::benchmarks
