#include "scene/gltf/load_parts.h"

namespace prelight {

std::vector<std::string> loadVariants(const LoadContext& context) {
  std::vector<std::string> names;
  const auto extension = LoadContext::extension(context.root, "KHR_materials_variants");
  if (!extension) return names;
  extension->forEachObject("variants", [&](const JsonCursor& variant, std::size_t) {
    names.push_back(variant.at("name").asString());
  });
  return names;
}

int materialOfVariant(const LoadContext& context, const JsonCursor& primitive, int variant, int own) {
  if (variant < 0) return own;
  const auto extension = LoadContext::extension(primitive, "KHR_materials_variants");
  if (!extension) return own;
  int material = own;
  extension->forEachObject("mappings", [&](const JsonCursor& mapping, std::size_t) {
    const JsonCursor variants = mapping.at("variants");
    for (std::size_t i = 0; i < variants.arraySize(); ++i)
      if (variants.at(i).asUnsigned() == static_cast<std::uint64_t>(variant))
        material =
            static_cast<int>(mapping.at("material").asIndex(context.root.countOf("materials"), "material"));
  });
  return material;
}

}  // namespace prelight
