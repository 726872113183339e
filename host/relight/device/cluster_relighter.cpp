#include "relight/device/cluster_relighter.h"

#include "prelight/error.h"
#include "relight/device/compressed_light.h"

namespace prelight {

namespace {

/// Returns the transfer without what each receiver has of its own.
CompressedTransfer sharedPart(const CompressedTransfer& transfer) {
  CompressedTransfer shared;
  shared.method = transfer.method;
  shared.order = transfer.order;
  shared.channels = transfer.channels;
  shared.clusters = transfer.clusters;
  shared.components = transfer.components;
  shared.means = transfer.means;
  shared.basis = transfer.basis;
  shared.weights = transfer.weights;
  shared.weightRanges = transfer.weightRanges;
  return shared;
}

}  // namespace

ClusterRelighter::ClusterRelighter(DeviceContext& device, const CompressedTransfer& transfer)
    : device_(device), shared_(sharedPart(transfer)), receivers_(transfer.vertexCount) {
  if (transfer.clusters == 0)
    throw UsageError("relighting", "got transfer without clusters, expected pca, vq or cpca");
  clusters_ = Buffer<std::uint16_t>(device, std::span<const std::uint16_t>(transfer.clusterOf));
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
  stored_ = Stored<Number>{Buffer<Number>(device_, std::span<const Number>(weights)),
                           {device_, "relight/cluster_kernels.cl", options, "relightClusters"}};
  weightBytes_ = weights.size() * sizeof(Number);
}

std::size_t ClusterRelighter::bytesMoved() const {
  return (clusters_.size() > 0 ? clusters_.bytes() : 0) + weightBytes_ + receivers_ * 3 * sizeof(float);
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
        stored.kernel.launch(receivers_, terms_, clusters_, stored.weights,
                             static_cast<std::uint32_t>(receivers_), radiance);
      },
      stored_);
}

}  // namespace prelight
