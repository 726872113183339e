#include "techniques/chart_transfer/chart_caster.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "base/kept_work.h"
#include "base/parallel.h"
#include "base/work_share.h"
#include "basis/sh.h"
#include "fit/texel_fill.h"
#include "receivers/chart_sampler.h"
#include "scene/surface/relief.h"
#include "techniques/chart_transfer/relief_transfer.h"

namespace prelight {

namespace {

constexpr std::uint32_t leastRaysPerReceiver = 16;  // as of vertices (schedule.cpp)
constexpr std::size_t partValues = widestPart;

std::uint32_t raysPerReceiver(const ChartTransferOptions& options) {
  return std::max(leastRaysPerReceiver, options.rays / ChartSampler::positionsPerTexel);
}

CastOptions castOptionsOfCharts(const ChartTransferOptions& options) {
  CastOptions cast;
  cast.raysPerReceiver = raysPerReceiver(options);
  cast.marksInside = true;
  cast.limits = options.limits;
  cast.sets = options.sets;
  cast.setTracers = options.setTracers;
  return cast;
}

/// A block's rows alone are kept, until they have been gathered.
TransportShape transportShape(const ChartTransferOptions& options, const DeviceInfo& device) {
  const std::uint32_t rows = receiversPerBlock(device, raysPerReceiver(options));
  return {rows, rows, static_cast<std::size_t>(options.order * options.order)};
}

class ChartCaster {
 public:
  ChartCaster(const CompiledScene& scene, const Charts& charts, Tracer& tracer,
              const ChartTransferOptions& options, Progress& progress, ChartTransferReport& report)
      : scene_(scene),
        charts_(charts),
        options_(options),
        progress_(progress),
        report_(report),
        columns_(static_cast<std::size_t>(options.order * options.order)),
        hemisphere_(options.order),
        caster_(scene, tracer, castOptionsOfCharts(options), makeColumns(tracer.context().info())),
        receiversPerTexel_(options.rays / caster_.raysPerReceiver()),
        open_(columns_),
        reflected_(parts()) {}

  void setSurface(const FitMesh& mesh, const SlotTransfer& surface) {
    const std::vector<float> sent = sentTransfer(mesh, surface, columns_);
    const std::size_t values = 3 * columns_;
    // A texel may see a back that no vertex has seen; nothing is known of it, and it stays dark.
    places_ = 2 * std::size_t{scene_.vertexCount()};
    transport_->resizeTransfer(parts() * places_ * partValues);
    std::vector<float> part;
    for (std::size_t p = 0; p < parts(); ++p) {
      part.assign(places_ * partValues, 0.0f);
      for (std::size_t place = 0; place < sent.size() / values; ++place)
        std::copy_n(&sent[place * values + p * partValues], std::min(partValues, values - p * partValues),
                    &part[place * partValues]);
      transport_->setTransfer(part, p * part.size());
    }
  }

  ChartTransfer run() {
    ChartTransfer transfer{options_.order, static_cast<int>(channels()), options_.bounces, {}};
    WorkPart part(progress_, "texels", [&](auto& state) { exchange(state, transfer.maps); });
    std::optional<SharedLoop> loop;  // over the texels of all charts
    while (transfer.maps.size() < charts_.charts.size()) {
      if (!sampler_) begin(transfer.maps.size());
      if (!loop) loop.emplace(part, "texels");
      castChart(part, *loop, transfer.maps.size());
      transfer.maps.push_back(finish(charts_.charts[transfer.maps.size()]));
      part.advance();
    }
    if (loop) loop->end();
    part.finish();
    return transfer;
  }

 private:
  /// Keeps the maps that are done and the places of the one at hand, and takes them up again.
  template <typename State>
  void exchange(State& state, std::vector<ChartTransfer::Map>& maps) {
    std::uint64_t done = maps.size();
    bool begun = sampler_.has_value();
    state.value(done);
    state.value(begun);
    state.require(done + (begun ? 1 : 0) <= charts_.charts.size());
    for (std::uint64_t i = 0; i < done; ++i) {
      if (i == maps.size()) maps.push_back(mapOf(charts_.charts[i], {}));
      ChartTransfer::Map& map = maps[i];
      state.growing(map.coefficients);
      state.require(map.coefficients.size() == map.texels() * rowLength());
      state.requireFinite(map.coefficients);
    }
    state.value(report_.texels);
    state.value(report_.hidden);
    state.value(report_.rays);
    if (!begun) return;
    if (!sampler_) begin(done);
    state.value(place_);
    state.require(place_ <= sampler_->texels().size());
    exchangePlaces(state, done);
  }

  void exchangePlaces(StateWriter& state, std::uint64_t chart) const {
    std::vector<float> rows;
    state.growing(chart, place_, (rowLength() + 1) * sizeof(float),
                  [&](std::uint64_t first, std::uint64_t count) {
                    rows.clear();
                    for (std::uint64_t place = first; place < first + count; ++place) {
                      const std::size_t texel = sampler_->texels()[place];
                      const auto row = sums_.begin() + static_cast<std::ptrdiff_t>(texel * rowLength());
                      rows.insert(rows.end(), row, row + static_cast<std::ptrdiff_t>(rowLength()));
                      rows.push_back(counts_[texel]);
                    }
                    return std::as_bytes(std::span(rows));
                  });
  }

  void exchangePlaces(StateReader& state, std::uint64_t /*chart*/) {
    std::vector<float> rows;
    state.growing(place_, (rowLength() + 1) * sizeof(float),
                  [&](std::uint64_t first, std::span<const std::byte> bytes) {
                    rows.resize(bytes.size() / sizeof(float));
                    std::memcpy(rows.data(), bytes.data(), bytes.size());
                    state.requireFinite(rows);
                    for (std::size_t i = 0; i < rows.size(); i += rowLength() + 1) {
                      const std::size_t texel = sampler_->texels()[first + i / (rowLength() + 1)];
                      std::copy_n(&rows[i], rowLength(), &sums_[texel * rowLength()]);
                      const float count = rows[i + rowLength()];
                      state.require(count >= 0.0f && count <= 255.0f);
                      counts_[texel] = static_cast<std::uint8_t>(count);
                    }
                  });
  }

  void begin(std::size_t index) {
    const Chart& chart = charts_.charts[index];
    sampler_.emplace(scene_, charts_, index, options_.seed);
    relief_ = options_.relief ? reliefOf(chart) : nullptr;
    const auto texels = static_cast<std::size_t>(chart.width) * static_cast<std::size_t>(chart.height);
    sums_.assign(texels * rowLength(), 0.0f);
    counts_.assign(texels, 0);
    place_ = 0;
  }

  void castChart(WorkPart& part, SharedLoop& loop, std::size_t index) {
    const std::size_t places = sampler_->texels().size();
    const auto perBlock = std::max<std::size_t>(1, caster_.blockSize() / receiversPerTexel_);
    while (place_ < places) {
      progress_.check();
      const std::size_t first = place_, count = std::min(perBlock, places - first);
      addBlock(loop, first, count, index);
      place_ += count;
      part.advance();
      progress_.report("texels",
                       (double(index) + double(first) / double(places)) / double(charts_.charts.size()));
    }
    report_.texels += places;
    sampler_.reset();
  }

  /// Sums up what the receivers of places see. The pieces of a chart follow on those of the ones before it.
  void addBlock(SharedLoop& loop, std::size_t first, std::size_t count, std::size_t index) {
    const std::size_t hiddenBefore = std::exchange(report_.hidden, 0);
    const std::uint64_t raysBefore = std::exchange(report_.rays, 0);
    loop.run(
        {report_.texels + first, count}, [&] { castBlock(*sampler_, first, count, charts_.charts[index]); },
        [&](auto& state) {
          for (std::size_t place = first; place < first + count; ++place) {
            const std::size_t texel = sampler_->texels()[place];
            const std::span<float> sum = std::span(sums_).subspan(texel * rowLength(), rowLength());
            state.elements(sum);
            state.value(counts_[texel]);
            state.requireFinite(sum);
          }
          state.value(report_.hidden);
          state.value(report_.rays);
        });
    report_.hidden += hiddenBefore;
    report_.rays += raysBefore;
  }

  void castBlock(const ChartSampler& sampler, std::size_t first, std::size_t count, const Chart& chart) {
    receivers_.clear();
    for (std::size_t place = first; place < first + count; ++place)
      for (std::uint32_t k = 0; k < receiversPerTexel_; ++k)
        receivers_.push_back(sampler.receiver(place, k, receiversPerTexel_, caster_.raysPerReceiver()));
    const std::uint32_t firstTriangle = scene_.primitives[chart.primitive].firstTriangle;
    const std::uint32_t set = options_.sets != nullptr ? options_.sets->setOf(firstTriangle) : 0;
    const std::uint64_t furtherRays = caster_.furtherRays();
    CastTask task{Side::Front, set};
    if (options_.bounces > 0) task.firstRow = 0;
    caster_.cast(receivers_, rows_, task);
    if (options_.bounces > 0) gather();
    report_.rays += receivers_.size() * caster_.raysPerReceiver() + caster_.furtherRays() - furtherRays;
    if (relief_ != nullptr) findHidden(sampler, first, chart);
    for (std::size_t r = 0; r < receivers_.size(); ++r)
      addReceiver(r, sampler.texels()[first + r / receiversPerTexel_]);
  }

  void gather() {
    for (std::size_t p = 0; p < parts(); ++p)
      transport_->gather(
          0, static_cast<std::uint32_t>(receivers_.size()),
          {static_cast<std::uint32_t>(p * partValues), static_cast<std::uint32_t>(p * places_)},
          reflected_[p]);
  }

  /// One for all charts of a texture and its scale; none: the chart has no bumps.
  const Relief* reliefOf(const Chart& chart) {
    if (!chart.normalImage) return nullptr;
    const std::uint32_t triangle = scene_.primitives[chart.primitive].firstTriangle;
    const CompiledMaterial& m = scene_.materials[scene_.triangleMaterials[triangle]];
    const auto key =
        std::tuple(*chart.normalImage, m.normalScale, m.normalTexture.wrapS, m.normalTexture.wrapT);
    const auto found = reliefs_.find(key);
    if (found != reliefs_.end()) return &found->second;
    return &reliefs_
                .emplace(key, Relief(charts_.normalImages[*chart.normalImage], m.normalTexture,
                                     double(m.normalScale)))
                .first->second;
  }

  /// What the relief hides of the receivers of a block, were nothing else there.
  void findHidden(const ChartSampler& sampler, std::size_t first, const Chart& chart) {
    hidden_.assign(receivers_.size() * columns_, 0.0);
    levelShare_.assign(receivers_.size(), 1.0);
    parallelRanges(receivers_.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        const ChartSampler::Point at =
            sampler.point(first + r / receiversPerTexel_, static_cast<std::uint32_t>(r % receiversPerTexel_),
                          receiversPerTexel_);
        const auto frame = normalTextureFrame(scene_, charts_, chart, at.triangle, at.weights, at.normal);
        if (!frame) continue;
        const float* n = receivers_[r].normal;
        const glm::dvec3 bumped(n[0], n[1], n[2]);
        levelShare_[r] = 0.5 * (1.0 + glm::dot(bumped, at.normal));
        hiddenByRelief({at.normal, frame->tangent, frame->bitangent, relief_->horizonAt(frame->place)},
                       bumped, options_.order, std::span(hidden_).subspan(r * columns_, columns_));
      }
    });
  }

  /// Shares of what comes straight and of what is reflected by others that the relief of a receiver hides,
  /// given its accessibility without it: of what is open, other things take as much as of all.
  std::pair<double, double> sharesHidden(std::size_t r, double accessibility) const {
    if (relief_ == nullptr) return {0.0, 0.0};
    constexpr double rootOfFourPi = 3.5449077018110318;
    const double level = std::max(levelShare_[r], 1e-3),
                 hidden = hidden_[r * columns_] * rootOfFourPi / level;
    return {std::clamp(accessibility / level, 0.0, 1.0), std::clamp(hidden, 0.0, 1.0)};
  }

  void addReceiver(std::size_t r, std::uint32_t texel) {
    if (rows_.inside[r] != 0) {
      ++report_.hidden;
      return;
    }
    const float* values = hemisphere_.row(rows_, r);
    const float* normal = receivers_[r].normal;
    sh::openTransfer(glm::dvec3(normal[0], normal[1], normal[2]), options_.order, open_);
    float* sum = &sums_[texel * rowLength()];
    ++counts_[texel];
    const auto [straight, reflected] = sharesHidden(r, double(values[0]));
    for (std::size_t c = 0; c < rowLength() / columns_; ++c)
      for (std::size_t i = 0; i < columns_; ++i) {
        // As in projectHits: the kernel's values are relative to the open part of the open hemisphere.
        double direct = double(values[HemisphereColumn::firstBand + i]) + double(values[0]) * open_[i];
        if (relief_ != nullptr) direct -= straight * hidden_[r * columns_ + i];
        const std::size_t value = c * columns_ + i;
        float more =
            options_.bounces > 0 ? reflected_[value / partValues][r * partValues + value % partValues] : 0.0f;
        if (options_.specular.mirrors) more += rows_.of(*specular_).of<float>()[r * 3 * columns_ + value];
        sum[value] += static_cast<float>(direct + (1.0 - reflected) * double(more));
      }
  }

  ChartTransfer::Map finish(const Chart& chart) {
    for (std::size_t texel = 0; texel < counts_.size(); ++texel) {
      for (std::size_t i = 0; counts_[texel] > 0 && i < rowLength(); ++i)
        sums_[texel * rowLength() + i] /= static_cast<float>(counts_[texel]);
      counts_[texel] = counts_[texel] > 0 ? 1 : 0;
    }
    fillTexels(chart.width, chart.height, rowLength(), counts_, sums_);
    return mapOf(chart, std::move(sums_));
  }

  static ChartTransfer::Map mapOf(const Chart& chart, std::vector<float> coefficients) {
    return {chart.primitive, chart.width, chart.height, chart.coords, std::move(coefficients)};
  }

  std::vector<Column*> makeColumns(const DeviceInfo& device) {
    std::vector<Column*> columns{&hemisphere_};
    if (options_.specular.followed()) columns.push_back(&specular_.emplace(options_.specular));
    if (options_.bounces > 0)
      columns.push_back(
          &transport_.emplace(transportShape(options_, device), specular_ ? &*specular_ : nullptr));
    return columns;
  }

  std::size_t parts() const { return (3 * columns_ + partValues - 1) / partValues; }
  std::size_t channels() const { return options_.bounces > 0 || options_.specular.mirrors ? 3 : 1; }
  std::size_t rowLength() const { return columns_ * channels(); }

  const CompiledScene& scene_;
  const Charts& charts_;
  const ChartTransferOptions& options_;
  Progress& progress_;
  ChartTransferReport& report_;
  std::size_t columns_;
  HemisphereColumn hemisphere_;
  std::optional<SpecularColumn> specular_;
  std::optional<StoredTransport> transport_;
  Caster caster_;
  std::uint32_t receiversPerTexel_;
  std::vector<double> open_;
  std::vector<device::Receiver> receivers_;
  CastRows rows_;
  std::map<std::tuple<std::size_t, float, WrapMode, WrapMode>, Relief> reliefs_;
  const Relief* relief_ = nullptr;  ///< of the chart at hand; nullptr: bumps shadow nothing
  std::vector<double> hidden_;      ///< [receiver][column]
  std::vector<double> levelShare_;  ///< [receiver], of the bumped hemisphere that lies above the surface
  std::size_t places_ = 0;          ///< of the transfer on the device: vertices and their backs
  std::vector<std::vector<float>> reflected_;  ///< [part][receiver][partValues]
  std::optional<ChartSampler> sampler_;        ///< of the chart at hand; none: no chart is begun
  std::uint64_t place_ = 0;                    ///< of the sampler's texels: those before it are done
  std::vector<float> sums_;                    ///< [texel][rowLength]
  std::vector<std::uint8_t> counts_;           ///< [texel], receivers in the sum
};

}  // namespace

ChartTransfer makeChartTransfer(const CompiledScene& scene, const Charts& charts, const FitMesh& mesh,
                                Tracer& tracer, const SlotTransfer& surface,
                                const ChartTransferOptions& options, Progress& progress,
                                ChartTransferReport& report) {
  ChartCaster caster(scene, charts, tracer, options, progress, report);
  if (options.bounces > 0) caster.setSurface(mesh, surface);
  return caster.run();
}

}  // namespace prelight
