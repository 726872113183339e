#include "denoise/denoiser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "denoise/oidn_library.h"
#include "prelight/error.h"

namespace prelight {

namespace {

void requireFinite(std::span<const glm::vec3> image, int width, const char* what) {
  const auto bad = std::find_if(image.begin(), image.end(), [](const glm::vec3& v) {
    return !std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z);
  });
  if (bad == image.end()) return;
  const std::ptrdiff_t at = bad - image.begin();
  throw Error(ExitCode::RuntimeFailure, "denoiser",
              fmt::format("{} at pixel ({}, {}) is not finite: {} {} {}", what, at % width, at / width,
                          bad->x, bad->y, bad->z),
              "leave denoising out to see the picture as it is");
}

std::string versionText(int version) {
  return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

}  // namespace

using Names = std::vector<const char*>;  ///< input images of a filter
using Flags = std::vector<const char*>;

/// The loaded library with a started device.
class Denoiser::Session {
 public:
  explicit Session(const DenoiserOptions& options)
      : library_(oidn::loadLibrary()),
        megabytes_(options.megabytes),
        device_(api().newDevice(oidn::cpuDevice), Release{api().releaseDevice}) {
    if (!device_) check("no processor that it supports was found");
    version_ = api().getDeviceInt(device_.get(), "version");
    if (version_ / 10000 != oidn::version)
      throw Error(
          ExitCode::RuntimeFailure, file(),
          fmt::format("is Open Image Denoise {}, expected version {}", versionText(version_), oidn::version),
          fmt::format("name the file of another one in the environment variable {}", oidn::libraryVariable));
    api().setDeviceInt(device_.get(), "numThreads", static_cast<int>(options.threads));
    api().setDeviceBool(device_.get(), "setAffinity", false);  // keeps the affinity that the caller has set
    api().commitDevice(device_.get());
    check("cannot be started");
  }

  const oidn::Api& api() const { return library_.api; }
  oidn::Device device() const { return device_.get(); }
  const std::string& file() const { return library_.file; }
  int version() const { return version_; }
  int megabytes() const { return megabytes_; }

  /// Throws the error of the last calls, if any.
  void check(const char* what) const {
    const char* message = nullptr;
    const int error = api().getDeviceError(device_.get(), &message);
    if (error == oidn::cancelled) throw Interrupted();
    if (error != oidn::noError || !device_)
      throw Error(
          error == oidn::outOfMemory ? ExitCode::OutOfMemory : ExitCode::RuntimeFailure, file(),
          fmt::format("Open Image Denoise {}: {}", what, message != nullptr ? message : "it gives no reason"),
          "leave denoising out, or try another version of the library");
  }

 private:
  struct Release {
    void (*release)(oidn::Device);
    void operator()(oidn::Device device) const { release(device); }
  };

  oidn::Library library_;
  int megabytes_;
  std::unique_ptr<oidn::DeviceObject, Release> device_;
  int version_ = 0;
};

/// A network with its images. It is set up anew when their size changes.
class Denoiser::Filter {
 public:
  /// `inputs` are names of images; the output is the first of them without its noise. The session must
  /// outlive the filter.
  Filter(const Session& session, const char* kind, Names inputs, const Flags& flags)
      : session_(session),
        inputs_(std::move(inputs)),
        images_(inputs_.size() + 1),
        filter_(session.api().newFilter(session.device(), kind), Release{session.api().releaseFilter}) {
    if (!filter_) session_.check("has no such filter");
    for (const char* flag : flags) session_.api().setFilterBool(filter_.get(), flag, true);
    session_.api().setFilterInt(filter_.get(), "maxMemoryMB", session_.megabytes());
    session_.api().setFilterProgressMonitorFunction(filter_.get(), goesOn, this);
  }

  /// Makes a filter for pictures whose guides have no noise.
  static std::unique_ptr<Filter> guided(const Session& session, DenoiseEffort effort) {
    auto filter =
        std::make_unique<Filter>(session, "RT", Names{"color", "albedo", "normal"}, Flags{"hdr", "cleanAux"});
    if (effort == DenoiseEffort::Quick) filter->makeSmaller();
    return filter;
  }

  /// Makes a filter for a guide, which has little noise.
  static std::unique_ptr<Filter> ofGuide(const Session& session, const char* name) {
    auto filter = std::make_unique<Filter>(session, "RT", Names{name}, Flags{});
    filter->makeSmaller();
    return filter;
  }

  /// Returns the output, which stays valid until the next call.
  std::span<const glm::vec3> run(int width, int height,
                                 std::initializer_list<std::span<const glm::vec3>> inputs,
                                 const Progress& progress) {
    if (width != width_ || height != height_) resize(width, height);
    auto image = images_.begin();
    for (const std::span<const glm::vec3> input : inputs) {
      requireFinite(input, width, inputs_[static_cast<std::size_t>(image - images_.begin())]);
      std::copy(input.begin(), input.end(), (image++)->begin());
    }
    progress_ = &progress;
    session_.api().executeFilter(filter_.get());
    session_.check("failed");
    requireFinite(images_.back(), width, "its result");
    return images_.back();
  }

 private:
  struct Release {
    void (*release)(oidn::Filter);
    void operator()(oidn::Filter filter) const { release(filter); }
  };

  static bool goesOn(void* filter, double) {
    return !static_cast<Filter*>(filter)->progress_->stopRequested();
  }

  void makeSmaller() { session_.api().setFilterInt(filter_.get(), "quality", oidn::balancedQuality); }

  void resize(int width, int height) {
    for (std::size_t i = 0; i < images_.size(); ++i) {
      images_[i].assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::vec3(0.0f));
      session_.api().setSharedFilterImage(
          filter_.get(), i < inputs_.size() ? inputs_[i] : "output", images_[i].data(), oidn::float3Format,
          static_cast<std::size_t>(width), static_cast<std::size_t>(height), 0, 0, 0);
    }
    session_.api().commitFilter(filter_.get());
    session_.check("cannot be set up");
    width_ = width;
    height_ = height;
  }

  const Session& session_;
  Names inputs_;
  std::vector<std::vector<glm::vec3>> images_;  ///< [input], followed by the output
  std::unique_ptr<oidn::FilterObject, Release> filter_;
  const Progress* progress_ = nullptr;  ///< progress of the running call
  int width_ = 0, height_ = 0;
};

Denoiser::Denoiser(const DenoiserOptions& options)
    : session_(std::make_unique<Session>(options)),
      name_("Open Image Denoise " + versionText(session_->version())) {}

Denoiser::~Denoiser() = default;

const std::string& Denoiser::file() const { return session_->file(); }

Picture Denoiser::denoise(const Picture& noisy, const Guides& guides, DenoiseEffort effort,
                          const Progress& progress) {
  std::unique_ptr<Filter>& filter = picture_[static_cast<std::size_t>(effort)];
  if (!filter) filter = Filter::guided(*session_, effort);
  std::span<const glm::vec3> albedo = guides.albedo, normal = guides.normal;
  if (effort == DenoiseEffort::Full || guides.noisy) {
    if (!albedo_) albedo_ = Filter::ofGuide(*session_, "albedo");
    if (!normal_) normal_ = Filter::ofGuide(*session_, "normal");
    albedo = albedo_->run(noisy.width, noisy.height, {albedo}, progress);
    normal = normal_->run(noisy.width, noisy.height, {normal}, progress);
  }
  const auto clean = filter->run(noisy.width, noisy.height, {noisy.pixels, albedo, normal}, progress);
  return {noisy.width, noisy.height, {clean.begin(), clean.end()}};
}

void Denoiser::denoise(LightMapQuantity quantity, int width, int height, std::span<glm::vec3> image,
                       const Progress& progress) {
  std::unique_ptr<Filter>& filter = lightMap_[static_cast<std::size_t>(quantity)];
  std::span<const glm::vec3> clean;
  if (quantity == LightMapQuantity::Light) {
    // The guides of a white wall: with them the large network for pictures errs less than the one for light
    // maps.
    const std::vector<glm::vec3> white(image.size(), glm::vec3(1.0f)),
        facing(image.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    if (!filter) filter = Filter::guided(*session_, DenoiseEffort::Full);
    clean = filter->run(width, height, {image, white, facing}, progress);
  } else {
    if (!filter)
      filter = std::make_unique<Filter>(*session_, "RTLightmap", Names{"color"}, Flags{"directional"});
    clean = filter->run(width, height, {image}, progress);
  }
  std::copy(clean.begin(), clean.end(), image.begin());
}

}  // namespace prelight
