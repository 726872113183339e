#include "lightmap/texel_receiver.h"

namespace prelight {

device::Receiver receiverAt(const CompiledScene& scene, const LightMapTexel& texel) {
  const bool back = texel.face >= scene.triangleCount();
  const std::uint32_t triangle = back ? texel.face - scene.triangleCount() : texel.face;
  return receiverAt(scene, {triangle, texel.b1, texel.b2, 1.0f}, back ? Side::Back : Side::Front);
}

}  // namespace prelight
