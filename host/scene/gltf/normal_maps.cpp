#include "scene/gltf/normal_maps.h"

#include <map>

#include "scene/gltf/image_decode.h"

namespace prelight {

NormalMaps loadNormalMaps(const GltfDocument& document, const Scene& scene, Warnings& warnings) {
  NormalMaps maps;
  std::map<int, int> placeOf;  // of the file's images
  for (const Material& material : scene.materials) {
    const int image = material.normalTexture.image;
    maps.imageOf.push_back(-1);
    if (image < 0) continue;
    const auto [found, fresh] = placeOf.try_emplace(image, -1);
    if (fresh) {
      const std::size_t before = warnings.size();
      Image loaded = loadImage(document, static_cast<std::size_t>(image), warnings);
      if (warnings.size() == before) {
        found->second = static_cast<int>(maps.images.size());
        maps.images.push_back(std::move(loaded));
      }
    }
    maps.imageOf.back() = found->second;
  }
  return maps;
}

}  // namespace prelight
