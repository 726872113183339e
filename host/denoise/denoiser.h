#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "base/parallel.h"
#include "denoise/guides.h"
#include "prelight/picture.h"
#include "prelight/progress.h"

namespace prelight {

/// What images of a light map hold.
enum class LightMapQuantity : std::uint8_t {
  Light,       ///< irradiance or radiance, >= 0
  Directions,  ///< coefficients over their band 0, in [-1,1]
};

/// How much work a picture is worth.
enum class DenoiseEffort : std::uint8_t {
  Full,   ///< the largest network, and guides that are filtered before
  Quick,  ///< a smaller one; guides are filtered where they are noisy
};

struct DenoiserOptions {
  std::size_t threads = hardwareThreads();
  int megabytes = 1024;  ///< of a filter's working memory, about: larger images are filtered in tiles
};

/// Takes noise out of images by neural networks: Intel Open Image Denoise, found at run time, on processors.
/// The same input gives the same output. One thread may use it at a time.
class Denoiser {
 public:
  /// Throws Error telling how to get the library where it is missing or of another version.
  explicit Denoiser(const DenoiserOptions& options = {});
  ~Denoiser();
  Denoiser(const Denoiser&) = delete;
  Denoiser& operator=(const Denoiser&) = delete;

  /// "Open Image Denoise 2.5.1".
  const std::string& name() const { return name_; }
  const std::string& file() const;  ///< of the library

  /// A picture of radiance. Throws Error where the filter fails, where what goes in or comes out is not
  /// finite, and Interrupted.
  Picture denoise(const Picture& noisy, const Guides& guides, DenoiseEffort effort, const Progress& progress);

  /// An image of a light map, [y][x], in place; throws the same.
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
