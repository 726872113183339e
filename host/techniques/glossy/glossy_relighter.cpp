#include "techniques/glossy/glossy_relighter.h"

#include <fmt/format.h>

#include "basis/sh_evaluate.h"
#include "prelight/error.h"

namespace prelight {

namespace {

std::size_t vertexCountOf(const GlossyTransfer& transfer) {
  const auto n = static_cast<std::size_t>(transfer.order * transfer.order);
  const std::size_t each = static_cast<std::size_t>(transfer.channels) * n * n;
  return each == 0 ? 0 : transfer.matrices.size() / each;
}

}  // namespace

GlossyRelighter::GlossyRelighter(DeviceContext& device, const GlossyTransfer& transfer)
    : device_(device),
      launch_(device.info()),
      order_(static_cast<std::size_t>(transfer.order)),
      channels_(static_cast<std::size_t>(transfer.channels)),
      vertices_(vertexCountOf(transfer)) {
  const std::size_t n = order_ * order_;
  const auto tiles = tiled(std::span<const float>(transfer.matrices), channels_ * n * n);
  matrices_ = Buffer<float>(device, std::span<const float>(tiles));
  light_ = Buffer<float>(device, 3 * n);
  arriving_ = Buffer<float>(device, tileCount(vertices_) * 3 * n * tileVertices);
  lobe_ = Buffer<float>(device, order_);
  table_ = Buffer<float>(device, std::span<const float>(makeShTable(transfer.order)));
  const BuildOptions options = launch_.options()
                                   .define("PRELIGHT_ORDER", transfer.order)
                                   .define("PRELIGHT_CHANNELS", transfer.channels);
  lightKernel_ = {device, "techniques/glossy/glossy_kernels.cl", options, "lightMatrices"};
  shadeKernel_ = {device, "techniques/glossy/glossy_kernels.cl", options, "shadeGlossy"};
}

std::size_t GlossyRelighter::bytesMoved() const {
  const std::size_t n = order_ * order_;
  return vertices_ * sizeof(float) * (channels_ * n * n + 3 * n);
}

void GlossyRelighter::light(std::span<const double> light) {
  if (light.size() != 3 * order_ * order_)
    throw UsageError("light",
                     fmt::format("got {} coefficients, expected 3 x {}", light.size(), order_ * order_));
  const std::vector<float> values(light.begin(), light.end());
  light_.write(std::span<const float>(values));
  lightKernel_.launch(launch_.size(vertices_), matrices_, light_, static_cast<std::uint32_t>(vertices_),
                      arriving_);
}

std::vector<float> GlossyRelighter::arriving() const {
  const std::vector<float> tiles = arriving_.read();
  const std::size_t rows = 3 * order_ * order_;
  std::vector<float> out(vertices_ * rows);
  for (std::size_t v = 0; v < vertices_; ++v)
    for (std::size_t row = 0; row < rows; ++row)
      out[v * rows + row] = tiles[(v / tileVertices * rows + row) * tileVertices + v % tileVertices];
  return out;
}

void GlossyRelighter::shade(Buffer<float>& directions, std::span<const double> lobe,
                            Buffer<float>& radiance) {
  if (lobe.size() != order_)
    throw UsageError("lobe", fmt::format("got {} bands, expected {}", lobe.size(), order_));
  if (vertices_ == 0) return;
  const std::vector<float> values(lobe.begin(), lobe.end());
  lobe_.write(std::span<const float>(values));
  shadeKernel_.launch(launch_.size(vertices_), arriving_, directions, lobe_, table_,
                      static_cast<std::uint32_t>(vertices_), radiance);
}

}  // namespace prelight
