#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// What pictures are sums of: light by its last steps to the eye. L: light, D: a surface that scatters
/// diffusely, G: by a rough lobe, S: as a mirror or glass, E: the eye. PRELIGHT_PART_* of
/// kernels/shared/reference_types.h.
enum class PicturePart : std::uint8_t {
  Emitted,    ///< LE: lamps and the sky as they are seen
  Direct,     ///< LDE, LGE: straight from lights
  Indirect,   ///< L(D or G)+DE, and with mirrors and glass among them
  Caustic,    ///< LS+DE
  Reflected,  ///< what mirrors, glass and rough lobes show but for lights in rough lobes
  Baked,      ///< light through what was baked, direct and indirect together
};
constexpr std::size_t pictureParts = 6, tracedParts = 5;

/// "emitted", ...: names of layers in .exr files.
std::string_view nameOf(PicturePart part);

/// A part of a picture, which is of the same size.
struct PartPicture {
  PicturePart part = PicturePart::Emitted;
  std::vector<glm::vec3> pixels;
};

/// Adds the channels NAME.R, NAME.G and NAME.B of each.
void addLayers(std::span<const PartPicture> parts, std::vector<PictureChannel>& layers);

}  // namespace prelight
