#include "radiosity/form_factor_cast.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/kept_work.h"
#include "base/spans.h"
#include "cast/caster.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::uint32_t mostRaysPerPoint = 16;
constexpr std::uint32_t maxBackRounds = 4;  // backs seen from backs, and so on

std::vector<glm::uvec2> piecesOf(const RadiosityElements& elements) {
  std::vector<glm::uvec2> pieces;
  for (std::size_t t = 0; t < elements.splits.size(); ++t)
    pieces.emplace_back(elements.first[t], elements.splits[t]);
  return pieces;
}

/// Returns per triangle, [triangle], bit 0: it reflects, bit 1: it transmits light.
std::vector<std::uint8_t> reflectingTriangles(const CompiledScene& scene) {
  std::vector<std::uint8_t> reflecting;
  for (const std::uint32_t material : scene.triangleMaterials) {
    const CompiledMaterial& m = scene.materials[material];
    reflecting.push_back(
        static_cast<std::uint8_t>((shines(m.albedo) ? 1 : 0) | (shines(m.diffuseTransmission) ? 3 : 0)));
  }
  return reflecting;
}

/// Writes or reads rows, which are only appended and never change.
template <typename State, typename Counts>
void exchangeRows(State& state, Counts& counts) {
  state.growing(counts.elements);
  state.growing(counts.offsets);
  state.growing(counts.columns);
  state.growing(counts.counts);
  state.growing(counts.rays);
  state.growing(counts.escaped);
  state.growing(counts.surface);
  state.growing(counts.valid);
}

}  // namespace

FormFactorCast::FormFactorCast(const CompiledScene& scene, const RadiosityElements& elements, Tracer& tracer,
                               std::uint32_t raysPerElement, std::uint64_t seed)
    : elements_(elements),
      tracer_(tracer),
      device_(tracer.context()),
      raysPerElement_(raysPerElement),
      raysPerPoint_(std::min(mostRaysPerPoint, raysPerElement)),
      pointsPerElement_(raysPerElement / raysPerPoint_),
      blockSize_(std::max(1u, receiversPerBlock(device_.info(), raysPerElement))),
      points_(scene, elements, seed),
      backCast_(scene.triangleCount(), 0),
      queue_(elements.perSide()),
      parameters_(device_, 1),
      receivers_(device_, std::size_t{blockSize_} * pointsPerElement_),
      elementPoints_(device_, receivers_.size()),
      rays_(device_, std::size_t{blockSize_} * raysPerElement),
      hits_(device_, rays_.size()),
      codes_(device_, rays_.size()),
      judged_(device_, receivers_.size()),
      pieces_(device_, spanOf(piecesOf(elements))),
      normals_(device_, spanOf(orientedNormals(scene))),
      twoSided_(device_, spanOf(twoSidedTriangles(scene))),
      reflecting_(device_, spanOf(reflectingTriangles(scene))),
      marks_(device_, scene.triangleCount()) {
  std::iota(queue_.begin(), queue_.end(), 0u);
  counts_.offsets.push_back(0);
  marks_.fill(0);
  generate_ = {device_, "cast/generate_kernels.cl", {}, "generateRays"};
  const char* file = "radiosity/form_factor_kernels.cl";
  code_ = {device_, file, tracer_.surfaceOptions(), "codeElements"};
  judge_ = {device_, file, tracer_.surfaceOptions(), "judgePoints"};
}

void FormFactorCast::run(Progress& progress) {
  WorkPart part(progress, "form factors", keptBy(*this));
  if (part.finished()) return;
  do {
    if (done_ < queue_.size()) runRound(progress, part);
  } while (startRound());
  part.finish();
}

void FormFactorCast::runRound(Progress& progress, WorkPart& part) {
  SharedLoop loop(part, round_ == 0 ? std::string("form factors")
                                    : fmt::format("form factors of backs, round {}", round_));
  while (done_ < queue_.size()) {
    progress.check();
    const auto count = static_cast<std::uint32_t>(std::min<std::uint64_t>(blockSize_, queue_.size() - done_));
    addBlock(loop, count);
    done_ += count;
    part.advance();
    progress.report(round_ == 0 ? "form factors" : "form factors of backs",
                    double(done_) / double(queue_.size()));
  }
  loop.end();
}

/// Queues backs that no round has cast from yet. Returns false if there are none.
bool FormFactorCast::startRound() {
  if (round_ == maxBackRounds) return false;
  const std::vector<std::uint8_t> seen = marks_.read();
  std::vector<std::uint32_t> fresh;
  for (std::uint32_t t = 0; t < seen.size(); ++t) {
    if (!seen[t] || backCast_[t]) continue;
    backCast_[t] = 1;
    for (std::uint32_t piece = elements_.first[t]; piece < elements_.first[t + 1]; ++piece)
      fresh.push_back(elements_.perSide() + piece);
  }
  if (fresh.empty()) return false;
  ++round_;
  queue_ = std::move(fresh);
  done_ = 0;
  return true;
}

/// Adds the rows of the next elements of the queue, and the backs that their rays have met.
void FormFactorCast::addBlock(SharedLoop& loop, std::uint32_t count) {
  ExchangeCounts rows;
  std::vector<std::uint32_t> metBacks;
  const auto cast = [&] {
    rows.offsets.push_back(0);
    castBlock(count, rows);
    if (loop.divided()) metBacks = toldMarks_.fresh(marks_);
  };
  const bool known = loop.run({done_, count}, cast, [&](auto& state) {
    exchangeRows(state, rows);
    state.values(metBacks);
    state.check([&] { return areRowsOf(rows, count) && areTriangles(metBacks); });
  });
  if (!known) return;
  append(rows);
  mark(metBacks, marks_);
}

void FormFactorCast::append(const ExchangeCounts& rows) {
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  const std::uint64_t before = counts_.columns.size();
  for (std::size_t row = 1; row < rows.offsets.size(); ++row)
    counts_.offsets.push_back(before + rows.offsets[row]);
  add(counts_.elements, rows.elements);
  add(counts_.columns, rows.columns);
  add(counts_.counts, rows.counts);
  add(counts_.rays, rows.rays);
  add(counts_.escaped, rows.escaped);
  add(counts_.surface, rows.surface);
  add(counts_.valid, rows.valid);
}

void FormFactorCast::castBlock(std::uint32_t count, ExchangeCounts& rows) {
  const std::vector<ElementPoints::Place> places =
      points_.of(queue_, done_, count, pointsPerElement_, raysPerPoint_);
  std::vector<Receiver> receivers;
  std::vector<ElementPoint> points;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SurfaceSample& s = places[i].sample;
    const bool back = elements_.sideOf(queue_[done_ + i / pointsPerElement_]) == Side::Back;
    receivers.push_back(places[i].receiver);
    points.push_back({s.triangle, s.b1, s.b2, back ? 1u : 0u});
  }
  const auto pointCount = static_cast<std::uint32_t>(places.size());
  const auto rayCount = static_cast<std::uint32_t>(places.size() * raysPerPoint_);
  CastParameters parameters{};
  parameters.receiverCount = pointCount;
  parameters.raysPerReceiver = raysPerPoint_;
  parameters_.write(std::span<const CastParameters>(&parameters, 1));
  receivers_.write(spanOf(receivers));
  elementPoints_.write(spanOf(points));
  generate_.launch(rayCount / 8, parameters_, receivers_, rays_);
  tracer_.traceClosest(rays_, hits_, rayCount);
  code_.launch(rayCount, rayCount, elements_.perSide(), rays_, hits_, pieces_, normals_, reflecting_, codes_,
               marks_);
  judge_.launch(pointCount, pointCount, raysPerPoint_, tracer_.scene().layoutBuffer(),
                tracer_.scene().surface(), elementPoints_, rays_, hits_, normals_, twoSided_, judged_);
  std::vector<std::uint32_t> codes(rayCount);
  std::vector<glm::vec4> judged(pointCount);
  codes_.read(std::span(codes));
  judged_.read(std::span(judged));
  for (std::uint32_t i = 0; i < count; ++i)
    addRow(queue_[done_ + i], &codes[std::size_t{i} * raysPerElement_],
           &judged[std::size_t{i} * pointsPerElement_], rows);
}

void FormFactorCast::addRow(std::uint32_t element, const std::uint32_t* codes, const glm::vec4* judged,
                            ExchangeCounts& rows) {
  scratch_.clear();
  glm::vec4 surface(0.0f);
  std::uint32_t valid = 0;
  for (std::uint32_t p = 0; p < pointsPerElement_; ++p) {
    if (judged[p].w == 0.0f) continue;
    surface += judged[p];
    if (p < 32) valid |= 1u << p;
    const std::uint32_t* first = codes + std::size_t{p} * raysPerPoint_;
    scratch_.insert(scratch_.end(), first, first + raysPerPoint_);
  }
  if (surface.w > 0.0f)
    surface = glm::vec4(glm::vec3(surface) / surface.w, surface.w / float(pointsPerElement_));
  std::sort(scratch_.begin(), scratch_.end());
  std::uint32_t escaped = 0;
  for (std::size_t i = 0; i < scratch_.size();) {
    std::size_t end = i + 1;
    while (end < scratch_.size() && scratch_[end] == scratch_[i]) ++end;
    if (scratch_[i] == PRELIGHT_ESCAPED) {
      escaped = static_cast<std::uint32_t>(end - i);
    } else {
      rows.columns.push_back(scratch_[i]);
      rows.counts.push_back(static_cast<std::uint16_t>(end - i));
    }
    i = end;
  }
  rows.elements.push_back(element);
  rows.offsets.push_back(rows.columns.size());
  rows.rays.push_back(static_cast<std::uint32_t>(scratch_.size()));
  rows.escaped.push_back(escaped);
  rows.surface.push_back(surface);
  rows.valid.push_back(valid);
}

void FormFactorCast::save(StateWriter& state) const {
  state.value(round_);
  state.value(done_);
  state.values(queue_);
  state.values(backCast_);
  state.values(marks_.read());
  exchangeRows(state, counts_);
}

void FormFactorCast::load(StateReader& state) {
  state.value(round_);
  state.value(done_);
  state.values(queue_);
  state.sameSize(backCast_);
  std::vector<std::uint8_t> marks(marks_.size());
  state.sameSize(marks);
  marks_.write(spanOf(marks));
  exchangeRows(state, counts_);
  checkLoaded(state);
  for (const std::uint8_t mark : marks) state.require(mark <= 1);
}

void FormFactorCast::checkLoaded(const StateReader& state) const {
  const ExchangeCounts& c = counts_;
  const std::size_t rows = c.elements.size();
  const std::uint32_t elements = 2 * elements_.perSide();
  state.require(round_ <= maxBackRounds && done_ <= queue_.size() && done_ <= rows);
  state.require(areRows(c));
  for (const std::uint8_t cast : backCast_) state.require(cast <= 1);
  // The last rows must be the finished elements of the queue, and no element may occur twice.
  state.require(std::equal(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(done_),
                           c.elements.end() - static_cast<std::ptrdiff_t>(done_)));
  std::vector<std::uint8_t> known(elements, 0);
  const auto requireNew = [&](std::uint32_t element) {
    state.require(element < elements && known[element] == 0);
    known[element] = 1;
  };
  for (const std::uint32_t element : c.elements) requireNew(element);
  for (std::size_t i = done_; i < queue_.size(); ++i) requireNew(queue_[i]);
}

/// Returns whether rows are those of the next `count` elements of the queue.
bool FormFactorCast::areRowsOf(const ExchangeCounts& rows, std::uint32_t count) const {
  return rows.elements.size() == count && areRows(rows) &&
         std::equal(rows.elements.begin(), rows.elements.end(),
                    queue_.begin() + static_cast<std::ptrdiff_t>(done_));
}

bool FormFactorCast::areTriangles(const std::vector<std::uint32_t>& numbers) const {
  return std::all_of(numbers.begin(), numbers.end(), [&](std::uint32_t t) { return t < marks_.size(); });
}

/// Returns whether rows that come from a file are of one size, and each could have been cast.
bool FormFactorCast::areRows(const ExchangeCounts& c) const {
  const std::size_t rows = c.elements.size();
  if (c.offsets.size() != rows + 1 || c.rays.size() != rows || c.escaped.size() != rows ||
      c.surface.size() != rows || c.valid.size() != rows || c.columns.size() != c.counts.size() ||
      c.offsets.front() != 0 || c.offsets.back() != c.columns.size())
    return false;
  for (std::size_t row = 0; row < rows; ++row)
    if (!isRow(c, row)) return false;
  return true;
}

bool FormFactorCast::isRow(const ExchangeCounts& c, std::size_t row) const {
  const std::uint32_t elements = 2 * elements_.perSide();
  if (c.offsets[row] > c.offsets[row + 1] || c.offsets[row + 1] > c.columns.size()) return false;
  std::uint64_t rays = c.escaped[row];
  for (std::uint64_t i = c.offsets[row]; i < c.offsets[row + 1]; ++i) {
    if (c.columns[i] >= elements || (i > c.offsets[row] && c.columns[i - 1] >= c.columns[i])) return false;
    rays += c.counts[i];
  }
  const glm::vec4& surface = c.surface[row];
  for (int k = 0; k < 4; ++k)
    if (!(surface[k] >= 0.0f && surface[k] <= 1.001f)) return false;
  return rays == c.rays[row] && rays <= raysPerElement_ && (rays == 0 || surface.w > 0.0f);
}

}  // namespace prelight
