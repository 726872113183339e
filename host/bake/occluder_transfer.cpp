#include "bake/occluder_transfer.h"

#include <algorithm>
#include <array>

#include "bake/occluder_sums.h"
#include "shared/occluder_types.h"

namespace prelight {

namespace {

using device::OccluderSums;
using device::OccluderVertex;

constexpr std::size_t groupSize = 64;
constexpr double leastMeaning = 1e-7;  // form factor below which a record is rounding

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

OccluderMeans aggregate(const FitMesh& mesh, Caster& caster, const SideCast& front, Aggregator& aggregator,
                        Progress& progress) {
  OccluderMeans means(mesh);
  for (std::uint32_t first = 0; first < front.storedCount(); first += caster.blockSize()) {
    progress.check();
    const std::uint32_t count = std::min(caster.blockSize(), front.storedCount() - first);
    const auto receivers = std::span(front.storedReceivers()).subspan(first, count);
    aggregator.run(receivers, front.storedFirst() + first);
    for (std::uint32_t i = 0; i < count; ++i) {
      const SurfaceSample& sample = front.records()[first + i].sample;
      const double weight = front.fit().weightOf(sample);
      const Aggregator::Span& span = aggregator.spans()[i];
      means.addReceiver(sample, weight);
      for (std::uint32_t r = span.first; r < span.first + span.count; ++r)
        means.add(sample, weight, receivers[i], aggregator.records()[r]);
    }
    progress.report("occluders", double(first + count) / front.storedCount());
  }
  return means;
}

/// What a slot sees, so that its form factors add up, with the accessibility, to 1.
std::vector<SeenOccluder> normalized(std::vector<SeenOccluder> seen, double accessibility) {
  double sum = 0.0;
  for (const SeenOccluder& s : seen) sum += s.formFactor;
  for (SeenOccluder& s : seen) s *= sum > 0.0 ? (1.0 - accessibility) / sum : 0.0;
  return seen;
}

/// The vectors of a record of a vertex, in the order of `storedVectors`. Positions are the world's.
std::array<glm::vec4, 4> packRecord(const CompiledScene& scene, const SeenOccluder& seen,
                                    const glm::dvec3& vertex) {
  const double formFactor = seen.formFactor;
  const glm::dvec3 position = seen.position / formFactor;
  // The receivers around lie to one side of a vertex at a border; what their distances are more than that to
  // the mean position, the vertex' are, too.
  const double excess = seen.distance / std::max(glm::length(seen.offset), 1e-9 * seen.distance);
  const double distance = seen.distance > 0.0 ? glm::length(position - vertex) * excess : 0.0;
  return {glm::vec4(scene.origin + position, distance), glm::vec4(seen.direction, formFactor),
          glm::vec4(seen.normal, seen.accessibility),
          glm::vec4(glm::clamp(seen.color / formFactor, 0.0, 1.0), 0.0)};
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
  const OccluderMeans means = aggregate(mesh, caster, front, aggregator, progress);
  OccluderTransfer transfer{groups.names, storedVectors, {0}, {}, {}};
  const double least = std::max(leastFormFactor, leastMeaning);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const std::uint32_t slot = mesh.slotOfVertex[v];
    double dropped = 0.0;
    for (const SeenOccluder& seen : normalized(means.around(slot), accessibility[slot])) {
      if (seen.formFactor < least) {
        dropped += seen.formFactor;
        continue;
      }
      transfer.occluders.push_back(seen.group);
      for (const glm::vec4& vector : packRecord(scene, seen, scene.positions[v]))
        transfer.vectors.push_back(vector);
    }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.occluders.size()));
    report.droppedMean += dropped / scene.vertexCount();
    report.droppedMost = std::max(report.droppedMost, dropped);
  }
  report.receivers = front.storedCount();
  return transfer;
}

}  // namespace prelight
