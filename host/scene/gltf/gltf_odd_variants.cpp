#include <fmt/format.h>

#include <set>

#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/json_parts.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* variantsName = "KHR_materials_variants";

void findOddMapping(const Json& root, std::size_t variants, const Json& mapping, const std::string& place,
                    std::set<std::uint64_t>& seen, Oddities& odd) {
  const auto material = unsignedValue(part(mapping, "material"));
  if (!material || *material >= part(root, "materials").size())
    odd.add("a variant with a material that the file does not have", place + "/material");
  const Json& names = part(mapping, "variants");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto variant = unsignedValue(names[i]);
    const std::string within = fmt::format("{}/variants/{}", place, i);
    if (!variant || *variant >= variants) {
      odd.add("a variant that the file does not list", within);
    } else if (!seen.insert(*variant).second) {
      odd.add("a variant that has a material already; the last one counts", within);
    }
  }
}

}  // namespace

void findOddVariants(const Json& root, Oddities& odd) {
  const Json& extension = part(part(root, "extensions"), variantsName);
  const Json& listed = part(extension, "variants");
  if (extension.is_object() && !listed.is_array())
    odd.add("an extension without its variants", fmt::format("/extensions/{}", variantsName));
  forEachPart(root, "meshes", [&](const Json& mesh, const std::string& meshPlace) {
    const Json& primitives = part(mesh, "primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const Json& mappings = part(part(part(primitives[p], "extensions"), variantsName), "mappings");
      std::set<std::uint64_t> seen;
      for (std::size_t i = 0; i < mappings.size(); ++i)
        findOddMapping(
            root, listed.size(), mappings[i],
            fmt::format("{}/primitives/{}/extensions/{}/mappings/{}", meshPlace, p, variantsName, i), seen,
            odd);
    }
  });
}

}  // namespace prelight
