#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "device/kernel.h"
#include "prelight/picture.h"
#include "relight/device/band_rotator.h"

namespace prelight {

/// Projects equirectangular skies of one size on the device, so that a sky may change every frame. Tables are
/// made once on the host, in double precision. Sums have a fixed order.
class LightProjector {
 public:
  /// The device must outlive the projector. `order` from 1 to 32. The sky is black before the first one.
  LightProjector(DeviceContext& device, int width, int height, int order);

  /// Uploads a sky. Throws UsageError if its size differs from that of the tables, and InputError for one
  /// that is not finite or has another number of texels than its size says.
  void setSky(const Environment& sky);

  /// Turns the sky: f'(w) = f(R^-1 w). Throws UsageError for a matrix that is not orthonormal.
  void setRotation(const glm::dmat3& rotation);

  /// Returns the coefficients of the turned sky, [channel][i], 3 x order^2. Radiance is constant over each
  /// texel, and integrals over texels are exact. Each row is summed once per wave cos(m phi) and sin(m phi),
  /// so that the cost grows with texels x order. Waits for the result.
  std::vector<float> projectSh();

  /// Returns Haar coefficients of the turned sky on a cube map, [channel][face S^2 + row S + column]
  /// (basis/haar.h), from the mean radiance of samples x samples points per texel by lifting in place.
  /// `faceSize` is a power of two. Waits for the result.
  std::vector<float> projectWavelets(int faceSize, int samples);

 private:
  DeviceContext& device_;
  int width_, height_, order_;
  Buffer<float> sky_;  ///< [channel][row][column]
  Buffer<float> cosine_, sine_, polar_;
  Buffer<float> moments_, inSkyFrame_, coefficients_;
  glm::dmat3 rotation_{1.0};
  BandRotator toWorld_;  ///< from the sky's own frame, rotation included
  using Floats = Buffer<float>;
  Kernel<Floats, Floats, Floats, std::uint32_t, std::uint32_t, std::uint32_t, Floats> momentsKernel_;
  Kernel<Floats, Floats, std::uint32_t, std::uint32_t, Floats> coefficientsKernel_;
  Kernel<Floats, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, glm::vec4, glm::vec4, glm::vec4,
         Floats>
      cubeKernel_;
  Kernel<Floats, std::uint32_t, std::uint32_t, std::uint32_t> liftKernel_;
};

}  // namespace prelight
