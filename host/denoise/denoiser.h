#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "prelight/picture.h"
#include "prelight/progress.h"

namespace prelight {

/// Guides of a denoiser: the first surface that the camera sees, directly or in mirrors and through glass.
struct Guides {
  std::vector<glm::vec3> albedo;  ///< [pixel] in [0,1]
  std::vector<glm::vec3> normal;  ///< [pixel] world space, mean of unit vectors; 0 where there is no surface
  bool noisy = true;              ///< true where mirrors, glass or few samples leave noise in the guides
};

/// Content of a light map's images.
enum class LightMapQuantity : std::uint8_t {
  Light,       ///< irradiance or radiance, >= 0
  Directions,  ///< coefficients over their band 0, in [-1,1]
};

/// Work per picture.
enum class DenoiseEffort : std::uint8_t {
  Full,   ///< the largest network, with guides that are denoised first
  Quick,  ///< a smaller network; noisy guides are denoised first
};

struct DenoiserOptions {
  std::size_t threads = hardwareThreads();
  int megabytes = 1024;  ///< approximate working memory of a filter; larger images are filtered in tiles
};

/// Removes noise from images by the neural networks of Intel Open Image Denoise, which is loaded at run time
/// and runs on the CPU. Equal input gives equal output. Only one thread may use a denoiser at a time.
class Denoiser {
 public:
  /// Throws Error that tells how to get the library where it is missing or of another version.
  explicit Denoiser(const DenoiserOptions& options = {});
  ~Denoiser();
  Denoiser(const Denoiser&) = delete;
  Denoiser& operator=(const Denoiser&) = delete;

  /// Name and version, such as "Open Image Denoise 2.5.1".
  const std::string& name() const { return name_; }
  const std::string& file() const;  ///< path of the loaded library

  /// Returns a denoised picture of radiance. Throws Error where the filter fails or where input or output is
  /// not finite, and Interrupted.
  Picture denoise(const Picture& noisy, const Guides& guides, DenoiseEffort effort, const Progress& progress);

  /// Denoises an image of a light map, [y][x], in place. Throws as above.
  void denoise(LightMapQuantity quantity, int width, int height, std::span<glm::vec3> image,
               const Progress& progress);

 private:
  class Session;
  class Filter;

  std::unique_ptr<Session> session_;
  std::string name_;
  std::array<std::unique_ptr<Filter>, 2> picture_;  ///< [DenoiseEffort]
  std::unique_ptr<Filter> albedo_, normal_;
  std::array<std::unique_ptr<Filter>, 2> lightMap_;  ///< [LightMapQuantity]
};

}  // namespace prelight
