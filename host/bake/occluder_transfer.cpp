#include "bake/occluder_transfer.h"

#include <algorithm>
#include <array>
#include <limits>

#include "bake/occluder_sums.h"
#include "shared/occluder_types.h"

namespace prelight {

namespace {

using device::OccluderSums;
using device::OccluderVertex;

constexpr std::size_t groupSize = 64;
constexpr std::size_t groupsAtOnce = 4;  // of a solution
constexpr double leastMeaning = 1e-7;    // form factor below which a fit's value is rounding

struct Extent {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

/// Bounds of every occluder, scene coordinates: mean positions lie inside, whatever the fit overshoots.
std::vector<Extent> boundsOf(const CompiledScene& scene, const OccluderGroups& groups) {
  std::vector<Extent> boxes(groups.names.size());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    Extent& box = boxes[groups.groupOfVertex[v]];
    box.low = glm::min(box.low, glm::dvec3(scene.positions[v]));
    box.high = glm::max(box.high, glm::dvec3(scene.positions[v]));
  }
  return boxes;
}

std::vector<OccluderVertex> occluderVertices(const CompiledScene& scene, const FitMesh& mesh,
                                             const std::vector<double>& accessibility,
                                             const OccluderGroups& groups) {
  std::vector<OccluderVertex> vertices;
  vertices.reserve(scene.vertexCount());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const glm::vec3 p = scene.positions[v], n = scene.normals[v];
    vertices.push_back({{p.x, p.y, p.z},
                        static_cast<float>(accessibility[mesh.slotOfVertex[v]]),
                        {n.x, n.y, n.z},
                        groups.groupOfVertex[v]});
  }
  return vertices;
}

/// The device's part: what the receivers of stored rows see of each occluder.
class Aggregator {
 public:
  Aggregator(Caster& caster, DeviceContext& device, const std::vector<OccluderVertex>& vertices)
      : caster_(caster),
        device_(device),
        vertices_(device, std::span<const OccluderVertex>(vertices)),
        counter_(device, 1),
        spans_(device, caster.blockSize()),
        records_(device, std::size_t{caster.blockSize()} * caster.raysPerReceiver()),
        kernel_(device.program("project/occluder_kernels.cl", {}), "aggregateOccluders") {}

  struct Span {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  /// Fills spans() and records() for the rows of some receivers.
  void run(std::span<const device::Receiver> receivers, std::uint32_t firstRow) {
    const Caster::StoredRows rows = caster_.replay(receivers, firstRow);
    counter_.fill(0);
    setArguments(kernel_, rows.parameters.get(), rows.receivers.get(), rows.rays.get(), rows.senders.get(),
                 vertices_.get(), counter_.get(), spans_.get(), records_.get());
    device_.launch(kernel_, receivers.size(), groupSize);
    spansRead_.resize(receivers.size());
    spans_.read(std::span(spansRead_));
    recordsRead_.resize(counter_.read()[0]);
    if (!recordsRead_.empty()) records_.read(std::span(recordsRead_));
  }

  const std::vector<Span>& spans() const { return spansRead_; }
  const std::vector<OccluderSums>& records() const { return recordsRead_; }

 private:
  Caster& caster_;
  DeviceContext& device_;
  Buffer<OccluderVertex> vertices_;
  Buffer<std::uint32_t> counter_;
  Buffer<Span> spans_;
  Buffer<OccluderSums> records_;
  cl::Kernel kernel_;
  std::vector<Span> spansRead_;
  std::vector<OccluderSums> recordsRead_;
};

OccluderRightSides aggregate(const FitMesh& mesh, Caster& caster, const SideCast& front,
                             Aggregator& aggregator, Progress& progress) {
  OccluderRightSides sides(mesh);
  for (std::uint32_t first = 0; first < front.storedCount(); first += caster.blockSize()) {
    progress.check();
    const std::uint32_t count = std::min(caster.blockSize(), front.storedCount() - first);
    aggregator.run(std::span(front.storedReceivers()).subspan(first, count), front.storedFirst() + first);
    for (std::uint32_t i = 0; i < count; ++i) {
      const SurfaceSample& sample = front.records()[first + i].sample;
      const double weight = front.fit().weightOf(sample);
      const Aggregator::Span& span = aggregator.spans()[i];
      for (std::uint32_t r = span.first; r < span.first + span.count; ++r)
        sides.add(sample, weight, aggregator.records()[r]);
    }
    progress.report("occluders", double(first + count) / front.storedCount());
  }
  return sides;
}

/// A slot's fitted values of an occluder.
struct Fitted {
  std::uint32_t group = 0;
  std::array<double, OccluderRightSides::columns> values{};
};

bool isSeen(const Fitted& fitted) { return fitted.values[0] > 0.0; }

/// [slot], of the occluders near it.
std::vector<std::vector<Fitted>> solve(const FitMesh& mesh, const SideCast& front,
                                       const OccluderRightSides& sides, std::size_t groups,
                                       Progress& progress) {
  constexpr std::size_t columns = OccluderRightSides::columns;
  std::vector<std::vector<std::uint32_t>> near(mesh.slotCount());
  for (std::uint32_t slot = 0; slot < mesh.slotCount(); ++slot) near[slot] = sides.groupsNear(slot);
  std::vector<std::vector<Fitted>> fitted(mesh.slotCount());
  std::vector<Fitted> largest(mesh.slotCount());
  for (std::size_t first = 0; first < groups; first += groupsAtOnce) {
    progress.check();
    const std::size_t count = std::min(groupsAtOnce, groups - first), width = count * columns;
    std::vector<double> right(mesh.slotCount() * width, 0.0);
    for (std::size_t g = 0; g < count; ++g)
      sides.scatter(static_cast<std::uint32_t>(first + g), right, width, g * columns);
    const std::vector<double> solution = front.fit().solve(defaultSmoothing, right, width);
    const auto valuesOf = [&](std::uint32_t slot, std::size_t group) {
      Fitted values{static_cast<std::uint32_t>(group), {}};
      std::copy_n(solution.begin() + static_cast<std::ptrdiff_t>(slot * width + (group - first) * columns),
                  columns, values.values.begin());
      return values;
    };
    for (std::uint32_t slot = 0; slot < mesh.slotCount(); ++slot) {
      for (const std::uint32_t group : near[slot])
        if (group >= first && group < first + count) fitted[slot].push_back(valuesOf(slot, group));
      for (std::size_t group = first; group < first + count; ++group)
        if (solution[slot * width + (group - first) * columns] > largest[slot].values[0])
          largest[slot] = valuesOf(slot, group);
    }
  }
  // What a fit leaves where nothing near hides anything belongs to something, too.
  for (std::uint32_t slot = 0; slot < mesh.slotCount(); ++slot)
    if (std::none_of(fitted[slot].begin(), fitted[slot].end(), isSeen) && isSeen(largest[slot]))
      fitted[slot] = {largest[slot]};
  return fitted;
}

/// Form factors of a slot that are not negative and add up, with the accessibility, to 1.
void normalize(std::vector<Fitted>& fitted, double accessibility) {
  double sum = 0.0;
  for (Fitted& f : fitted) {
    f.values[0] = std::max(0.0, f.values[0]);
    sum += f.values[0];
  }
  const double scale = sum > 0.0 ? (1.0 - accessibility) / sum : 0.0;
  for (Fitted& f : fitted)
    for (double& value : f.values) value *= scale;
}

glm::dvec3 at(const Fitted& fitted, std::size_t first) {
  return {fitted.values[first], fitted.values[first + 1], fitted.values[first + 2]};
}

glm::dvec3 noLongerThan(const glm::dvec3& v, double length) {
  const double own = glm::length(v);
  return own > length ? v * (length / own) : v;
}

/// The vectors of a record, in the order of `storedVectors`. Positions are the world's.
std::array<glm::vec4, 4> packRecord(const CompiledScene& scene, const Fitted& fitted, const glm::vec3& vertex,
                                    const Extent& box) {
  const double formFactor = fitted.values[0];
  const glm::dvec3 mean = glm::dvec3(vertex) + at(fitted, 4) / formFactor;
  const glm::dvec3 position = scene.origin + glm::clamp(mean, box.low, box.high);
  const double weight = std::clamp(fitted.values[11], 0.0, formFactor);
  const glm::dvec3 color = glm::clamp(at(fitted, 12) / formFactor, 0.0, 1.0);
  const double distance = std::max(0.0, fitted.values[7] / formFactor);
  return {glm::vec4(position, distance), glm::vec4(noLongerThan(at(fitted, 1), formFactor), formFactor),
          glm::vec4(noLongerThan(at(fitted, 8), weight), weight), glm::vec4(color, 0.0)};
}

const std::vector<OccluderVector> storedVectors = {OccluderVector::Position, OccluderVector::Occlusion,
                                                   OccluderVector::DiffuseNormal,
                                                   OccluderVector::DiffuseColor};

}  // namespace

OccluderTransfer makeOccluderTransfer(const CompiledScene& scene, const FitMesh& mesh, Caster& caster,
                                      const SceneCast& cast, const std::vector<double>& accessibility,
                                      const OccluderGroups& groups, double leastFormFactor,
                                      Progress& progress, OccluderReport& report) {
  const SideCast& front = cast.front();
  Aggregator aggregator(caster, caster.device(), occluderVertices(scene, mesh, accessibility, groups));
  const OccluderRightSides sides = aggregate(mesh, caster, front, aggregator, progress);
  std::vector<std::vector<Fitted>> fitted = solve(mesh, front, sides, groups.names.size(), progress);
  for (std::uint32_t slot = 0; slot < mesh.slotCount(); ++slot) normalize(fitted[slot], accessibility[slot]);

  OccluderTransfer transfer{groups.names, storedVectors, {0}, {}, {}};
  const std::vector<Extent> boxes = boundsOf(scene, groups);
  const double least = std::max(leastFormFactor, leastMeaning);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    double dropped = 0.0;
    for (const Fitted& f : fitted[mesh.slotOfVertex[v]]) {
      if (f.values[0] < least) {
        dropped += f.values[0];
        continue;
      }
      transfer.occluders.push_back(f.group);
      for (const glm::vec4& vector : packRecord(scene, f, scene.positions[v], boxes[f.group]))
        transfer.vectors.push_back(vector);
    }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.occluders.size()));
    report.droppedMean += dropped / scene.vertexCount();
    report.droppedMost = std::max(report.droppedMost, dropped);
  }
  report.receivers = front.storedCount();
  report.recordsPerVertex = double(transfer.recordCount()) / scene.vertexCount();
  return transfer;
}

}  // namespace prelight
