#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace prelight {

/// SH transfer of every vertex. T_i = (1/pi) integral V max(n.w,0) Y_i dw plus bounces; the receiver's albedo
/// is not included, so exit radiance = albedo x sum L_i T_i.
struct ShTransfer {
  int order = 0;     ///< bands 0..order-1, order^2 coefficients
  int channels = 1;  ///< 3 with bounces, 1 without
  int bounces = 0;
  std::vector<float> coefficients;  ///< [vertex][channel][i]
};

/// How a bake was made; written to the file's root.
struct BakeInfo {
  std::string generator;
  std::uint64_t seed = 0;
  std::uint64_t rays = 0;  ///< rays cast in all
  double error = 0.0;      ///< estimated standard error of AO, RMS over the surface
  int bounces = 0;
  nlohmann::ordered_json plan;  ///< as Plan::toJson
  std::string device;
  double seconds = 0.0;
};

/// Baked values of every vertex of a CompiledScene, in its vertex order. A technique that was not asked for
/// is empty.
struct Bake {
  std::vector<float> ao;               ///< [vertex], cosine-weighted accessibility in [0,1], 1 = open
  std::vector<glm::vec3> bentNormals;  ///< [vertex], unit
  std::optional<ShTransfer> sh;
  BakeInfo info;
};

}  // namespace prelight
