#include "receivers/texel_receiver.h"

namespace prelight {

std::uint32_t triangleOf(const CompiledScene& scene, const LightMapTexel& texel) {
  return texel.face >= scene.triangleCount() ? texel.face - scene.triangleCount() : texel.face;
}

device::Receiver receiverAt(const CompiledScene& scene, const LightMapTexel& texel) {
  const std::uint32_t triangle = triangleOf(scene, texel);
  return receiverAt(scene, {triangle, texel.b1, texel.b2, 1.0f},
                    triangle == texel.face ? Side::Front : Side::Back);
}

}  // namespace prelight
