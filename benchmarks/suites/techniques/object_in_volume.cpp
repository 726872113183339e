#include "benchmarks/suites/techniques/object_in_volume.h"

#include <algorithm>
#include <array>

#include "relight/object_light.h"
#include "relight/shadowed_transfer.h"

namespace prelight::benchmarks {

namespace {

VertexRange behind(const CompiledScene& first, const CompiledScene& all) {
  return {first.vertexCount(), all.vertexCount() - first.vertexCount(), first.triangleCount(),
          all.triangleCount() - first.triangleCount()};
}

}  // namespace

TimedBake bakeAround(const ComparedScene& scene, const BakeRequest& request, const Device& device,
                     const Progress& progress) {
  const CompiledScene& whole = scene.scene.compiled;
  const CompiledScene& without = scene.put->without.compiled;
  TimedBake baked = timedBake(scene.put->without, request, device, progress);
  const VolumeTransfer volume = std::move(*baked.bake.volume);
  baked.bake.volume.reset();

  BakeRequest own;
  own.sh.order = VolumeReceiver::ownOrder(volume);
  own.effort.rays = request.effort.rays;
  VolumeObject object{behind(without, whole), *timedBake(scene.put->object, own, device, progress).bake.sh};

  HarmonicTransfer& sh = *baked.bake.sh;
  sh.coefficients.resize(std::size_t{whole.vertexCount()} * 3 * volume.columns(), 0.0f);
  ObjectLight light(whole, {without.triangleCount(), whole.triangleCount()}, volume, nullptr, device);
  const VertexRange rest{0, without.vertexCount(), 0, without.triangleCount()};
  ShadowedTransfer shadowed(whole, rest, baked.bake, light);
  baked.report.stageSeconds.emplace_back(
      "object", secondsOf([&] {
        const ObjectTransfer lit = light.transferOf(whole, object);
        std::copy(
            lit.sh.begin(), lit.sh.end(),
            sh.coefficients.begin() +
                static_cast<std::ptrdiff_t>(std::size_t{object.range.firstVertex} * 3 * volume.columns()));
        const std::array<VertexRange, 1> objects = {object.range};
        shadowed.writeTo(whole, objects, baked.bake);
      }));
  return baked;
}

}  // namespace prelight::benchmarks
