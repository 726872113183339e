#include "benchmarks/lab/cluster_relighter.h"

#include "base/error.h"
#include "benchmarks/lab/lab_kernels.h"
#include "relight/compressed_light.h"

namespace prelight {

namespace {

template <typename T>
Buffer<T> upload(DeviceContext& device, const std::vector<T>& values) {
  return Buffer<T>(device, std::span<const T>(values));
}

}  // namespace

ClusterRelighter::ClusterRelighter(DeviceContext& device, const CompressedTransfer& transfer)
    : device_(device), shared_(transfer), vertices_(transfer.vertexCount) {
  if (transfer.method == CompressionMethod::Half || transfer.method == CompressionMethod::Band8)
    throw UsageError("relighting", "got halves or bytes, expected clustered transfer");
  clusters_ = upload(device, transfer.clusterOf);
  shared_.weightFloats = {};
  shared_.weightHalves = {};
  shared_.weightBytes = {};
  shared_.clusterOf = {};
  terms_ = Buffer<float>(device, 4 * static_cast<std::size_t>(transfer.clusters * (1 + transfer.components)));
  const BuildOptions options = BuildOptions()
                                   .define("PRELIGHT_COMPONENTS", transfer.components)
                                   .define("PRELIGHT_STORAGE", static_cast<int>(transfer.weights))
                                   .defineIf(clusters_.size() > 0, "PRELIGHT_CLUSTERED");
  if (!transfer.weightHalves.empty())
    store(transfer.weightHalves, options);
  else if (!transfer.weightBytes.empty())
    store(transfer.weightBytes, options);
  else
    store(transfer.weightFloats, options);
}

template <typename Number>
void ClusterRelighter::store(const std::vector<Number>& weights, const BuildOptions& options) {
  stored_ = Stored<Number>{upload(device_, weights),
                           {device_, labKernel(device_, "cluster_kernels.cl"), options, "relightClusters"}};
  weightBytes_ = weights.size() * sizeof(Number);
}

std::size_t ClusterRelighter::bytesMoved() const {
  return (clusters_.size() > 0 ? clusters_.bytes() : 0) + weightBytes_ + vertices_ * 3 * sizeof(float);
}

void ClusterRelighter::setLight(std::span<const double> light) {
  const CompressedLight ready = lightOf(shared_, light);
  std::vector<float> terms;
  terms.reserve(4 * ready.terms.size());
  for (const glm::vec3& term : ready.terms) terms.insert(terms.end(), {term.x, term.y, term.z, 0.0f});
  terms_.write(std::span<const float>(terms));
}

void ClusterRelighter::relight(Buffer<float>& radiance) {
  std::visit(
      [&](auto& stored) {
        stored.kernel.launch(vertices_, terms_, clusters_, stored.weights,
                             static_cast<std::uint32_t>(vertices_), radiance);
      },
      stored_);
}

}  // namespace prelight
