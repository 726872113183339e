#include "charts/light_map_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/clocks.h"
#include "base/kept_work.h"
#include "charts/hidden_light.h"
#include "charts/seam_stitching.h"
#include "charts/texel_cells.h"
#include "charts/wall_search.h"

namespace prelight {

namespace {

constexpr std::size_t mostAtOnce = 4096;  // texels between two tests for interruption

/// Returns the irradiance of a texel's values, [channel 3][coefficients], summed over the channels.
float channelSum(const float* values, int coefficients) {
  return values[0] + values[coefficients] + values[2 * coefficients];
}

std::uint64_t raysOf(std::span<LightMapPart* const> parts) {
  std::uint64_t sum = 0;
  for (const LightMapPart* part : parts) sum += part->rays();
  return sum;
}

}  // namespace

std::string noteOf(const LightMapLayout& layout, const LightMapReport& report) {
  return fmt::format(
      "light map: {} x {} texels, {:.0f} % of them used by {} charts; {} inside objects; seams differ by "
      "{:.3g} W/m2 rms, {:.3g} before they were stitched",
      layout.width, layout.height,
      100.0 * double(layout.texels.size()) / double(std::max<std::size_t>(1, layout.texelCount())),
      layout.chartCount, report.hidden, report.jumpAfter, report.jumpBefore);
}

LightMapBake::LightMapBake(const CompiledScene& scene, Tracer& tracer, LightMapLayout layout,
                           int coefficients)
    : scene_(scene), tracer_(tracer) {
  map_.layout = std::move(layout);
  findWalls(scene, tracer, map_.layout);
  map_.coefficients = coefficients;
  map_.values.assign(3 * static_cast<std::size_t>(coefficients) * map_.layout.texelCount(), 0.0f);
  hidden_.assign(map_.layout.texels.size(), 0);
  sharp_.assign(map_.layout.texels.size(), 0.0f);
}

void LightMapBake::run(std::span<LightMapPart* const> parts, Progress& progress) {
  const TexelCells cells(scene_, map_.layout);
  WorkPart kept(progress, "light map", keptBy(*this));
  const std::size_t count = hidden_.size();
  runBlocks(kept, "light map", progress, done_, count,
            [&](SharedLoop& loop, std::size_t size) { addBlock(loop, parts, cells, done_, size); });
  const std::vector<std::uint32_t> edges = this->edges();
  runBlocks(kept, "edges of light", progress, refined_, edges.size(),
            [&](SharedLoop& loop, std::size_t size) {
              refineBlock(loop, parts, cells, std::span(edges).subspan(refined_, size));
            });
  kept.finish();
}

template <typename AddBlock>
void LightMapBake::runBlocks(WorkPart& kept, const char* stage, Progress& progress, std::uint64_t& done,
                             std::size_t count, const AddBlock& addBlock) {
  if (done == count) return;
  SharedLoop loop(kept, stage);
  Pace pace(fewestAtOnce, mostAtOnce);
  pace.next(mostAtOnce);
  if (loop.divided()) atOnce_ = SharedLoop::pieceSize(count, fewestAtOnce, mostAtOnce);
  while (done < count) {
    progress.check();
    const std::size_t size = std::min<std::size_t>(atOnce_, count - done);
    addBlock(loop, size);
    done += size;
    if (!loop.divided()) atOnce_ = pace.next(mostAtOnce);
    kept.advance();
    progress.report(stage, static_cast<double>(done) / static_cast<double>(count));
  }
  loop.end();
}

void LightMapBake::addBlock(SharedLoop& loop, std::span<LightMapPart* const> parts, const TexelCells& cells,
                            std::size_t first, std::size_t size) {
  const auto texels = std::span(map_.layout.texels).subspan(first, size);
  const auto hidden = std::span(hidden_).subspan(first, size);
  std::vector<float> values(size * length(), 0.0f), sharp(size, 0.0f);
  std::uint64_t rays = 0;
  const auto lightOf = [&](std::size_t i) { return channelSum(&values[i * length()], map_.coefficients); };
  const auto compute = [&] {
    const std::uint64_t before = raysOf(parts);
    for (LightMapPart* part : parts) {
      if (part->isSharp())
        for (std::size_t i = 0; i < size; ++i) sharp[i] -= lightOf(i);
      part->addOverCells(texels, cells, map_.coefficients, values, hidden);
      if (part->isSharp())
        for (std::size_t i = 0; i < size; ++i) sharp[i] += lightOf(i);
    }
    rays = raysOf(parts) - before;
  };
  loop.run({first, size}, compute, [&](auto& state) {
    state.sameSize(values);
    state.sameSize(sharp);
    state.elements(hidden);
    state.value(rays);
    state.requireFinite(values);
    state.requireFinite(sharp);
    for (const std::uint8_t is : hidden) state.require(is <= 1);
  });
  rays_ += rays;
  std::copy(sharp.begin(), sharp.end(), sharp_.begin() + static_cast<std::ptrdiff_t>(first));
  for (std::size_t i = 0; i < size; ++i)
    std::copy_n(&values[i * length()], length(), &map_.values[texels[i].texel * length()]);
}

void LightMapBake::refineBlock(SharedLoop& loop, std::span<LightMapPart* const> parts,
                               const TexelCells& cells, std::span<const std::uint32_t> edges) {
  std::vector<float> values(edges.size() * length(), 0.0f);
  std::uint64_t rays = 0;
  const auto compute = [&] {
    const std::uint64_t before = raysOf(parts);
    std::vector<LightMapTexel> texels;
    for (const std::uint32_t edge : edges) texels.push_back(map_.layout.texels[edge]);
    for (LightMapPart* part : parts) part->refine(texels, cells, map_.coefficients, values);
    rays = raysOf(parts) - before;
  };
  loop.run({refined_, edges.size()}, compute, [&](auto& state) {
    state.sameSize(values);
    state.value(rays);
    state.requireFinite(values);
  });
  rays_ += rays;
  corrections_.insert(corrections_.end(), values.begin(), values.end());
}

std::vector<std::uint32_t> LightMapBake::edges() const {
  std::vector<float> all;
  all.reserve(hidden_.size());
  for (const LightMapTexel& texel : map_.layout.texels)
    all.push_back(channelSum(&map_.values[texel.texel * length()], map_.coefficients));
  return edgeTexels(map_.layout, {sharp_, all, hidden_});
}

std::vector<float> LightMapBake::values() const {
  std::vector<float> values(hidden_.size() * length());
  for (std::size_t i = 0; i < hidden_.size(); ++i)
    std::copy_n(&map_.values[map_.layout.texels[i].texel * length()], length(), &values[i * length()]);
  const std::vector<std::uint32_t> edges = this->edges();
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t k = 0; k < length(); ++k) {
      float& value = values[edges[i] * length() + k];
      value += corrections_[i * length() + k];
      const bool irradiance = k % static_cast<std::size_t>(map_.coefficients) == 0;
      if (irradiance) value = std::max(value, 0.0f);  // rounding may make it negative
    }
  return values;
}

// Texels are processed in the order of their indices.
void LightMapBake::save(StateWriter& state) const {
  state.value(done_);
  state.value(refined_);
  state.value(atOnce_);
  state.value(rays_);
  state.growing(hidden_, done_);
  state.growing(sharp_, done_);
  state.growing(corrections_);
  std::vector<float> rows;
  state.growing(0, done_, length() * sizeof(float), [&](std::uint64_t first, std::uint64_t count) {
    rows.resize(count * length());
    for (std::uint64_t i = 0; i < count; ++i)
      std::copy_n(&map_.values[map_.layout.texels[first + i].texel * length()], length(),
                  &rows[i * length()]);
    return std::as_bytes(std::span(rows));
  });
}

void LightMapBake::load(StateReader& state) {
  state.value(done_);
  state.value(refined_);
  state.value(atOnce_);
  state.value(rays_);
  state.require(done_ <= hidden_.size() && refined_ <= hidden_.size());
  state.require(refined_ == 0 || done_ == hidden_.size());
  state.require(atOnce_ >= fewestAtOnce && atOnce_ <= mostAtOnce);
  state.growing(hidden_, done_);
  for (const std::uint8_t hidden : hidden_) state.require(hidden <= 1);
  state.growing(sharp_, done_);
  state.requireFinite(sharp_);
  state.growing(corrections_);
  state.require(corrections_.size() == refined_ * length());
  state.requireFinite(corrections_);
  const std::size_t rowBytes = length() * sizeof(float);
  state.growing(done_, rowBytes, [&](std::uint64_t first, std::span<const std::byte> rows) {
    for (std::size_t i = 0; i < rows.size() / rowBytes; ++i)
      std::memcpy(&map_.values[map_.layout.texels[first + i].texel * length()], &rows[i * rowBytes],
                  rowBytes);
  });
  state.requireFinite(map_.values);
}

LightMap LightMapBake::finish(double creaseAngle, LightMapReport& report,
                              const std::function<void(LightMap&)>& filter, const Progress& progress) const {
  report.rays = rays_;
  report.hidden = static_cast<std::size_t>(std::count(hidden_.begin(), hidden_.end(), 1));
  LightMap map = map_;  // a copy, because the state may still be saved
  const std::vector<float> values = this->values();
  for (std::size_t i = 0; i < hidden_.size(); ++i)
    std::copy_n(&values[i * length()], length(), &map.values[map.layout.texels[i].texel * length()]);
  if (!map.layout.walls.empty())
    for (std::size_t i = 0; i < hidden_.size(); ++i)
      if (hidden_[i] != 0) map.layout.walls[map.layout.texels[i].texel].inside = true;
  fillHidden(hidden_, map);
  if (filter) {
    filter(map);
    fillHidden(hidden_, map);
  }
  const std::vector<SeamPoint> seams = seamsOf(scene_, tracer_, map.layout, creaseAngle);
  report.jumpBefore = seamJump(map, seams);
  stitchSeams(seams, map, progress);
  report.jumpAfter = seamJump(map, seams);
  return map;
}

void keepCoefficients(LightMap& map, int coefficients) {
  const auto before = static_cast<std::size_t>(map.coefficients),
             after = static_cast<std::size_t>(coefficients);
  std::vector<float> kept;
  kept.reserve(map.values.size() / before * after);
  for (std::size_t first = 0; first < map.values.size(); first += before)
    kept.insert(kept.end(), &map.values[first], &map.values[first] + after);
  map.values = std::move(kept);
  map.coefficients = coefficients;
}

}  // namespace prelight
