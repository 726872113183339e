#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "images/decode_picture.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/json_parts.h"
#include "scene/gltf/missing_data.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

/// Returns the limit of each component as a float, like the values; `none` where the accessor states none, or
/// limits of something else: those of normalised integers are limits of the integers.
std::vector<float> limitsOf(const Json& accessor, const char* name, std::size_t components, float none) {
  std::vector<float> limits(components, none);
  const Json& stated = part(accessor, name);
  if (part(accessor, "normalized") == true || !stated.is_array()) return limits;
  for (std::size_t c = 0; c < std::min(components, stated.size()); ++c)
    limits[c] = static_cast<float>(numberOf(stated[c], none));
  return limits;
}

void findOddNumbers(const Json& accessor, const AccessorReader& reader, const std::string& place,
                    Oddities& odd) {
  const std::size_t components = reader.components();
  const std::vector<float> low = limitsOf(accessor, "min", components, -INFINITY);
  const std::vector<float> high = limitsOf(accessor, "max", components, INFINITY);
  const std::vector<float> values = reader.floats();
  bool finite = true, within = true;
  for (std::size_t i = 0; i < values.size(); i += components) {
    for (std::size_t c = 0; c < components; ++c) {
      finite = finite && std::isfinite(values[i + c]);
      within = within && !(values[i + c] < low[c]) && !(values[i + c] > high[c]);
    }
  }
  if (!finite) odd.add("values that are not finite", place);
  if (!within) odd.add("values outside of min and max, which are not needed", place);
}

}  // namespace

void forReadable(const GltfDocument& document, std::uint64_t accessor, std::uint64_t& left,
                 const std::function<void(const AccessorReader&)>& visit) {
  const Json& json = partAt(part(document.json, "accessors"), static_cast<std::size_t>(accessor));
  const auto index = static_cast<std::size_t>(accessor);
  try {
    if (!json.is_object() || !json.contains("bufferView") || lacksData(document, index)) return;
    const AccessorReader reader(document, index);
    const std::uint64_t numbers = reader.count() * std::uint64_t{reader.components()};
    if (numbers > left) return;
    left -= numbers;
    visit(reader);
  } catch (const InputError&) {
    // Broken data that is not used has been reported.
  }
}

void warnOfOddValues(const GltfDocument& document, Warnings& warnings) {
  // Accessors may share their data, so that a small file could make this loop very long.
  std::uint64_t left = std::uint64_t{1} << 24, leftOfUses = left;
  Oddities odd;
  std::size_t index = 0;
  forEachPart(document.json, "accessors", [&](const Json& accessor, const std::string& place) {
    forReadable(document, index++, left,
                [&](const AccessorReader& reader) { findOddNumbers(accessor, reader, place, odd); });
  });
  findOddVertices(document, leftOfUses, odd);
  findOddMatrices(document, leftOfUses, odd);
  const Json& views = part(document.json, "bufferViews");
  forEachPart(document.json, "images", [&](const Json& image, const std::string& place) {
    const Json& view = partAt(views, part(image, "bufferView"));
    if (!view.is_object() || view.value("buffer", missingBuffer) == missingBuffer) return;
    const auto bytes =
        std::span(document.bin)
            .subspan(view.value("byteOffset", std::size_t{0}), view.value("byteLength", std::size_t{0}));
    const PictureFormat format = pictureFormat(bytes);
    if (format == PictureFormat::Unknown || (isDecoded(format) && !pictureExtent(bytes)))
      odd.add("data that are no picture", place);
  });
  odd.addTo(warnings, document.path.string());
}

}  // namespace prelight
