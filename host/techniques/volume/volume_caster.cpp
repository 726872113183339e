#include "techniques/volume/volume_caster.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/kept_work.h"
#include "base/work_share.h"
#include "basis/sh_evaluate.h"
#include "receivers/surface_sampler.h"

namespace prelight {

namespace {

using namespace device;

/// Bands by direction that are gathered, and those that are kept of transfer, which has many values a band.
constexpr int gatheredOrder = 3, transferSentOrder = 2;
constexpr std::size_t gatheredBands = gatheredOrder * gatheredOrder;

class VolumeCaster {
 public:
  VolumeCaster(const CompiledScene& scene, const FitMesh& mesh, Tracer& tracer, const SlotTransfer& surface,
               const VolumeGrid& grid, const VolumeOptions& options)
      : tracer_(tracer),
        device_(tracer.context()),
        grid_(grid),
        options_(options),
        columns_(static_cast<std::size_t>(options.order * options.order)),
        sentColumns_(columns_ + (options.lights ? surface.groups : 0)),
        blockSize_(receiversPerBlock(device_.info(), options.rays)),
        vertexCount_(scene.vertexCount()),
        lower_(grid.min - scene.origin),
        parameters_(device_, 1),
        shTable_(device_, std::span<const float>(makeShTable(options.order))),
        rays_(device_, std::size_t{blockSize_} * options.rays),
        hits_(device_, std::size_t{blockSize_} * options.rays),
        geometricNormals_(device_, std::span<const float>(orientedNormals(scene))),
        twoSided_(device_, std::span<const std::uint8_t>(twoSidedTriangles(scene))),
        values_(device_, blockSize_ * (1 + columns_)) {
    const char* file = "techniques/volume/volume_kernels.cl";
    const BuildOptions build = tracer.surfaceOptions()
                                   .define("PRELIGHT_SH_ORDER", options.order)
                                   .define("PRELIGHT_COLUMNS", static_cast<int>(sentColumns_))
                                   .define("PRELIGHT_SENT_ORDER", gatheredOrder);
    generate_ = {device_, file, build, "generateVolumeRays"};
    project_ = {device_, file, build, "projectVolume"};
    if (options.bounces == 0) return;
    gather_ = {device_, file, build, "gatherVolume"};
    backs_ = surface.backReflected.empty() ? 0 : 1;
    transfer_ = Buffer<float>(
        device_, std::span<const float>(sentTransfer(mesh, surface, columns_, sentColumns_ - columns_)));
    reflected_ = Buffer<float>(device_, blockSize_ * gatheredValues());
  }

  VolumeTransfer run(Progress& progress) {
    VolumeTransfer volume{grid_, options_.order, options_.bounces > 0 ? 3 : 1, options_.bounces, {}, {}, {}};
    if (options_.bounces > 0) volume.sentOrder = transferSentOrder;
    if (sentColumns_ > columns_ && options_.bounces > 0) volume.lightOrder = gatheredOrder;
    const auto count = static_cast<std::uint32_t>(grid_.count());
    std::uint32_t first = 0;
    WorkPart part(progress, "volume", [&](auto& state) {
      state.value(first);
      exchange(state, first, volume);
    });
    if (first == count) return volume;
    SharedLoop loop(part, "volume");
    while (first < count) {
      progress.check();
      const std::uint32_t some = std::min(blockSize_, count - first);
      addBlock(loop, first, some, volume);
      progress.report("volume", double(first) / count);
      first += some;
      part.advance();
    }
    loop.end();
    part.finish();
    return volume;
  }

 private:
  template <typename State>
  void exchange(State& state, std::uint32_t cells, VolumeTransfer& volume) const {
    state.growing(volume.air);
    state.require(volume.air.size() == cells && cells <= grid_.count());
    state.check(
        [&] { return std::all_of(volume.air.begin(), volume.air.end(), [](auto air) { return air <= 1; }); });
    const std::size_t reflected = options_.bounces > 0 ? 3 * columns_ : 0;
    const std::pair<std::vector<float>&, std::size_t> arrays[] = {
        {volume.coefficients, options_.bounces > 0 ? reflected : columns_},
        {volume.direct, options_.bounces > 0 ? columns_ : 0},
        {volume.sent, reflected * volume.sentBands()},
        {volume.lights, options_.bounces > 0 ? 3 * volume.lightBands() * (sentColumns_ - columns_) : 0}};
    for (const auto& [values, width] : arrays) {
      state.growing(values);
      state.require(values.size() == cells * width);
      state.requireFinite(values);
    }
  }

  void addBlock(SharedLoop& loop, std::uint32_t first, std::uint32_t count, VolumeTransfer& volume) {
    std::vector<float> values(count * (1 + columns_)),
        reflected(options_.bounces > 0 ? count * gatheredValues() : 0);
    loop.run(
        {first, count}, [&] { castBlock(first, count, values, reflected); },
        [&](auto& state) {
          state.sameSize(values);
          state.sameSize(reflected);
          state.requireFinite(values);
          state.requireFinite(reflected);
        });
    append(values, reflected, volume);
  }

  void castBlock(std::uint32_t first, std::uint32_t count, std::vector<float>& values,
                 std::vector<float>& reflected) {
    const CastParameters parameters{count,
                                    options_.rays,
                                    0,
                                    vertexCount_,
                                    0,
                                    static_cast<float>(options_.limits.nearest),
                                    static_cast<float>(reachOf(options_.limits)),
                                    static_cast<float>(options_.limits.obscurance)};
    parameters_.write(std::span(&parameters, 1));
    const glm::vec4 lower(glm::vec3(lower_), grid_.cell());
    const glm::uvec4 size(glm::uvec3(grid_.size), first);
    const auto seed = static_cast<std::uint32_t>(options_.seed ^ options_.seed >> 32);
    generate_.launch(std::size_t{count} * options_.rays / 8, parameters_, lower, size, seed, rays_);
    tracer_.traceClosest(rays_, hits_, std::size_t{count} * options_.rays);
    project_.launch(count, parameters_, shTable_, rays_, hits_, geometricNormals_, twoSided_, values_);
    values_.read(std::span(values));
    if (options_.bounces > 0) gather(count, reflected);
  }

  void gather(std::uint32_t count, std::vector<float>& reflected) {
    gather_.launch(count, parameters_, tracer_.scene().layoutBuffer(), tracer_.scene().surface(),
                   geometricNormals_, rays_, hits_, transfer_, backs_, reflected_);
    reflected_.read(std::span(reflected));
  }

  std::size_t gatheredValues() const { return 3 * gatheredBands * sentColumns_; }

  /// What is gathered from a voxel in a channel by the function Y_j of directions.
  std::span<const float> gathered(const std::vector<float>& reflected, std::size_t voxel, std::size_t channel,
                                  std::size_t j) const {
    return std::span(reflected).subspan(
        voxel * gatheredValues() + (channel * gatheredBands + j) * sentColumns_, sentColumns_);
  }

  void append(const std::vector<float>& values, const std::vector<float>& reflected, VolumeTransfer& volume) {
    const bool bounces = !reflected.empty();
    for (std::size_t v = 0; v < values.size() / (1 + columns_); ++v) {
      const float* direct = &values[v * (1 + columns_) + 1];
      volume.air.push_back(values[v * (1 + columns_)] == 0.0f ? 1 : 0);
      auto& kept = bounces ? volume.direct : volume.coefficients;
      kept.insert(kept.end(), direct, direct + columns_);
      if (bounces) appendReflected(direct, reflected, v, volume);
    }
  }

  void appendReflected(const float* direct, const std::vector<float>& reflected, std::size_t voxel,
                       VolumeTransfer& volume) const {
    constexpr float wholeSphere = 4.0f * std::numbers::pi_v<float>;
    const float meanOfFirst = std::sqrt(wholeSphere);  // 1 / Y_00
    for (std::size_t c = 0; c < 3; ++c) {
      const std::span<const float> mean = gathered(reflected, voxel, c, 0);
      for (std::size_t i = 0; i < columns_; ++i)
        volume.coefficients.push_back(direct[i] + meanOfFirst * mean[i]);
      for (std::size_t j = 0; j < volume.sentBands(); ++j)
        for (const float value : gathered(reflected, voxel, c, j).first(columns_))
          volume.sent.push_back(wholeSphere * value);
      for (std::size_t j = 0; j < volume.lightBands(); ++j)
        for (const float value : gathered(reflected, voxel, c, j).subspan(columns_))
          volume.lights.push_back(wholeSphere * value);
    }
  }

  Tracer& tracer_;
  DeviceContext& device_;
  VolumeGrid grid_;
  VolumeOptions options_;
  std::size_t columns_;
  std::size_t sentColumns_;  ///< of what surfaces send: SH, then groups of lights
  std::uint32_t blockSize_;
  std::uint32_t vertexCount_;
  glm::dvec3 lower_;
  Buffer<CastParameters> parameters_;
  Buffer<float> shTable_;
  Buffer<Ray> rays_;
  Buffer<Hit> hits_;
  Buffer<float> geometricNormals_;
  Buffer<std::uint8_t> twoSided_;
  Buffer<float> values_;
  Buffer<float> transfer_;
  Buffer<float> reflected_;
  std::uint32_t backs_ = 0;
  Kernel<Buffer<CastParameters>, glm::vec4, glm::uvec4, std::uint32_t, Buffer<Ray>> generate_;
  Kernel<Buffer<CastParameters>, Buffer<float>, Buffer<Ray>, Buffer<Hit>, Buffer<float>, Buffer<std::uint8_t>,
         Buffer<float>>
      project_;
  Kernel<Buffer<CastParameters>, Buffer<SceneLayout>, Buffer<SurfaceLine>, Buffer<float>, Buffer<Ray>,
         Buffer<Hit>, Buffer<float>, std::uint32_t, Buffer<float>>
      gather_;
};

}  // namespace

VolumeTransfer makeVolume(const CompiledScene& scene, const FitMesh& mesh, Tracer& tracer,
                          const SlotTransfer& surface, const VolumeGrid& grid, const VolumeOptions& options,
                          Progress& progress) {
  return VolumeCaster(scene, mesh, tracer, surface, grid, options).run(progress);
}

}  // namespace prelight
