#include "viewer/hemisphere/opengl_hemispheres.h"

#include <bit>
#include <cmath>
#include <exception>
#include <numbers>

#include "receivers/sampling.h"

namespace prelight::viewer {
namespace {

constexpr HemisphereMap viewMap = HemisphereMap::Stereographic;
constexpr int viewSide = 32;

/// Returns an angle that depends on the place alone.
double turnAt(const HemispherePlace& place) {
  std::uint32_t hash = place.triangle;
  for (int a = 0; a < 3; ++a)
    hash = sampling::hashInteger(hash ^ std::bit_cast<std::uint32_t>(place.position[a]));
  return 2.0 * std::numbers::pi * std::ldexp(double(hash), -32);
}

}  // namespace

OpenGlHemispheres::OpenGlHemispheres(const CompiledScene& scene) {
  run([&] {
    context_.emplace();
    raster_.emplace(scene, viewMap, viewSide, HemisphereSums::FourPasses);
    const std::string size = std::to_string(viewSide);
    description_ = "OpenGL (" + context_->rendererName() + "), " +
                   hemisphereMapNames[static_cast<std::size_t>(viewMap)] + " discs of " + size + " x " +
                   size + " texels";
  });
}

OpenGlHemispheres::~OpenGlHemispheres() {
  run([&] {
    raster_.reset();
    context_.reset();
  });
}

std::vector<HemisphereView> OpenGlHemispheres::look(std::span<const HemispherePlace> places, int order) {
  std::vector<HemisphereReceiver> receivers;
  for (const HemispherePlace& place : places)
    receivers.push_back({place.position, glm::normalize(glm::dvec3(place.normal)), turnAt(place),
                         place.triangle, place.geometricNormal});
  std::vector<HemisphereView> views;
  run([&] { views = raster_->look(receivers, order); });
  return views;
}

void OpenGlHemispheres::run(const std::function<void()>& work) {
  std::exception_ptr failure;
  thread_.add([&] {
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
  });
  thread_.finish();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace prelight::viewer
