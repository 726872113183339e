#include "relight/cluster_relighter.h"

#include "base/error.h"
#include "relight/compressed_light.h"

namespace prelight {

namespace {

constexpr std::size_t groupSize = 64;

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
  floats_ = upload(device, transfer.weightFloats);
  halves_ = upload(device, transfer.weightHalves);
  bytes_ = upload(device, transfer.weightBytes);
  shared_.weightFloats = {};
  shared_.weightHalves = {};
  shared_.weightBytes = {};
  shared_.clusterOf = {};
  terms_ = Buffer<float>(device, 4 * static_cast<std::size_t>(transfer.clusters * (1 + transfer.components)));
  const BuildOptions options = BuildOptions()
                                   .define("PRELIGHT_COMPONENTS", transfer.components)
                                   .define("PRELIGHT_STORAGE", static_cast<int>(transfer.weights))
                                   .defineIf(clusters_.size() > 0, "PRELIGHT_CLUSTERED");
  kernel_ = cl::Kernel(device.program("relight/cluster_kernels.cl", options), "relightClusters");
}

std::size_t ClusterRelighter::bytesMoved() const {
  const auto of = [](const auto& buffer) { return buffer.size() > 0 ? buffer.bytes() : 0; };
  return of(clusters_) + of(floats_) + of(halves_) + of(bytes_) + vertices_ * 3 * sizeof(float);
}

void ClusterRelighter::setLight(std::span<const double> light) {
  const CompressedLight ready = lightOf(shared_, light);
  std::vector<float> terms;
  terms.reserve(4 * ready.terms.size());
  for (const glm::vec3& term : ready.terms) terms.insert(terms.end(), {term.x, term.y, term.z, 0.0f});
  terms_.write(std::span<const float>(terms));
}

void ClusterRelighter::relight(Buffer<float>& radiance) {
  const cl::Buffer& weights = halves_.size() > 0  ? halves_.get()
                              : bytes_.size() > 0 ? bytes_.get()
                                                  : floats_.get();
  setArguments(kernel_, terms_.get(), clusters_.get(), weights, static_cast<cl_uint>(vertices_),
               radiance.get());
  device_.launch(kernel_, vertices_, groupSize);
}

}  // namespace prelight
