#include "techniques/bake_fit.h"

#include <string>

#include "prelight/error.h"

namespace prelight {

void requireCount(const char* what, std::size_t got, std::size_t expected) {
  if (got == expected) return;
  throw Error(ExitCode::RuntimeFailure, what,
              "the bake has " + std::to_string(got) + " values, this scene needs " + std::to_string(expected),
              "bake this scene again");
}

void requireDrawable(const char* what, int order, int most, int channels) {
  if (order >= 1 && order <= most && (channels == 1 || channels == 3)) return;
  throw Error(ExitCode::RuntimeFailure, what,
              "order " + std::to_string(order) + " in " + std::to_string(channels) +
                  " channels; orders 1 to " + std::to_string(most) + " in 1 or 3 channels can be drawn");
}

std::size_t rowNumbers(std::uint32_t vertices, int channels, int order, int power) {
  std::size_t count = std::size_t{vertices} * static_cast<std::size_t>(channels);
  for (int i = 0; i < power; ++i) count *= static_cast<std::size_t>(order);
  return count;
}

void requireHarmonics(const char* what, const HarmonicTransfer& transfer, const CompiledScene& scene) {
  requireDrawable(what, transfer.order, maxTransferOrder, transfer.channels);
  requireCount(what, transfer.coefficients.size(),
               rowNumbers(scene.vertexCount(), transfer.channels, transfer.order, 2));
}

}  // namespace prelight
