#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/lab/lab_kernels.h"
#include "device/kernel.h"
#include "gpu/albedo_table.h"
#include "gpu/anisotropic_table.h"
#include "shared/albedo_types.h"
#include "support/devices.h"

namespace prelight::test {

/// Results of benchmarks/lab/kernels/bsdf_probe_kernels.cl for pairs of directions.
struct Probed {
  std::vector<glm::vec4> scattered;  ///< Diffuse and glossy part for each pair, times the cosine.
  std::vector<float> densities;      ///< Density with which the second direction would have been drawn, 1/sr.

  double total(std::size_t i) const {
    return static_cast<double>(scattered[2 * i].x + scattered[2 * i + 1].x);
  }
};

/// A drawn sample; all 0 if no light goes on.
struct ProbedSample {
  glm::vec4 direction;
  float density;  ///< 1/sr.
  glm::vec3 weight;

  bool goesOn() const { return density > 0.0f; }
};

/// A surface whose scattering is evaluated on the device. `values` are in the order that probeBsdf() reads.
class BsdfProbe {
 public:
  BsdfProbe(BuildOptions options, std::vector<float> values, const GlassSurface& glass = {})
      : options_(std::move(options)),
        values_(std::move(values)),
        albedos_(makeAlbedoTable(has("PRELIGHT_LAYERS"))) {
    if (has("PRELIGHT_ANISOTROPY")) append(makeAnisotropicTable());
    albedos_.resize(PRELIGHT_ANISOTROPIC_END);
    if (has("PRELIGHT_ROUGH_GLASS")) append(makeGlassTable(glass));
  }

  /// Appends to the table and returns the place of the appended values.
  std::size_t append(const std::vector<glm::vec4>& more) {
    const std::size_t first = albedos_.size();
    albedos_.insert(albedos_.end(), more.begin(), more.end());
    return first;
  }

  void set(std::size_t value, float to) { values_.at(value) = to; }

  Probed probe(const std::vector<glm::vec4>& wo, const std::vector<glm::vec4>& wi) const {
    DeviceContext& device = sharedDevice().context();
    const Buffer<float> surface(device, std::span<const float>(values_));
    const Buffer<glm::vec4> albedos(device, std::span<const glm::vec4>(albedos_));
    const Buffer<glm::vec4> from(device, std::span<const glm::vec4>(wo)),
        to(device, std::span<const glm::vec4>(wi));
    const Buffer<glm::vec4> scattered(device, 2 * wo.size());
    const Buffer<float> densities(device, wo.size());
    launchOnce(device, labKernel(device, file), options_, "probeReflection", wo.size(), surface, albedos,
               static_cast<std::uint32_t>(wo.size()), from, to, scattered, densities);
    return {scattered.read(), densities.read()};
  }

  std::vector<ProbedSample> sample(const glm::vec4& wo, std::size_t count) const {
    DeviceContext& device = sharedDevice().context();
    const Buffer<float> surface(device, std::span<const float>(values_));
    const Buffer<glm::vec4> albedos(device, std::span<const glm::vec4>(albedos_));
    const Buffer<glm::vec4> from(device, std::span<const glm::vec4>(&wo, 1)), samples(device, 2 * count);
    launchOnce(device, labKernel(device, file), options_, "probeScatter", count, surface, albedos,
               static_cast<std::uint32_t>(count), from, samples);
    const std::vector<glm::vec4> read = samples.read();
    std::vector<ProbedSample> drawn(count);
    for (std::size_t i = 0; i < count; ++i)
      drawn[i] = {glm::vec4(glm::vec3(read[2 * i]), 0.0f), read[2 * i].w, glm::vec3(read[2 * i + 1])};
    return drawn;
  }

 private:
  static constexpr const char* file = "bsdf_probe_kernels.cl";

  bool has(std::string_view define) const { return options_.text().find(define) != std::string::npos; }

  BuildOptions options_;
  std::vector<float> values_;
  std::vector<glm::vec4> albedos_;
};

inline glm::vec4 directionOf(double cosine, double azimuth) {
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine, 0.0};
}

}  // namespace prelight::test
