#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// The parts of light that sum up to a picture, by the last segments of paths to the eye. L: light, D:
/// diffuse surface, G: rough lobe, S: mirror or glass, E: eye. The values are those of PRELIGHT_PART_* in
/// kernels/shared/reference_types.h.
enum class PicturePart : std::uint8_t {
  Emitted,    ///< LE: visible lamps and sky
  Direct,     ///< LDE, LGE: straight from lights
  Indirect,   ///< L(D or G)+DE, possibly with mirrors and glass in between
  Caustic,    ///< LS+DE
  Reflected,  ///< light seen in mirrors, glass and rough lobes, except that of lights in rough lobes
  Baked,      ///< direct and indirect light from baked data
};
constexpr std::size_t pictureParts = 6, tracedParts = 5;

/// Returns the name of a part's layers in .exr files, such as "emitted".
std::string_view nameOf(PicturePart part);

/// Pixels of a part, as many as the picture has.
struct PartPicture {
  PicturePart part = PicturePart::Emitted;
  std::vector<glm::vec3> pixels;
};

/// Adds the channels NAME.R, NAME.G and NAME.B of each part.
void addLayers(std::span<const PartPicture> parts, std::vector<PictureChannel>& layers);

}  // namespace prelight
