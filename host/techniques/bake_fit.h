#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

/// Parts of what shadings say of a bake (techniques/shading.h).
namespace prelight {

/// Largest order of SH and CH transfer that shaders evaluate: maxTransferOrder of
/// techniques/sh/transfer.glsl.
constexpr int maxTransferOrder = 32;

/// Throws Error where a bake has not as many values as the scene needs.
void requireCount(const char* what, std::size_t got, std::size_t expected);

/// Throws Error for orders and numbers of channels that shaders do not draw.
void requireDrawable(const char* what, int order, int most, int channels);

/// vertices * channels * order^power
std::size_t rowNumbers(std::uint32_t vertices, int channels, int order, int power);

/// Throws Error where harmonic transfer does not fit a scene or cannot be drawn.
void requireHarmonics(const char* what, const HarmonicTransfer& transfer, const CompiledScene& scene);

/// `asked` if it is positive, else `otherwise`.
constexpr int orDefault(int asked, int otherwise) { return asked > 0 ? asked : otherwise; }

/// Moves a part of a bake into another bake, if it is there.
template <typename Part>
void takePart(std::optional<Part>& into, std::optional<Part>& from) {
  if (from) into = std::exchange(from, std::nullopt);
}

}  // namespace prelight
