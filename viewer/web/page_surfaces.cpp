#include <array>
#include <map>
#include <tuple>

#include "gpu/albedo_table.h"
#include "gpu/surface_upload.h"
#include "images/picture_codecs.h"
#include "scene/lobes.h"
#include "viewer/programs/material_uniforms.h"
#include "viewer/programs/shader_variant.h"
#include "viewer/programs/surface_uniforms.h"
#include "viewer/web/page_parts.h"

namespace prelight::viewer {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(float value) { return value; }
Json jsonOf(int value) { return value; }
template <int length>
Json jsonOf(const glm::vec<length, float>& value) {
  return numbersOf(value);
}

/// The file's own bytes of an image that browsers read; empty where it has none.
std::span<const std::uint8_t> encodedImage(const GltfDocument& document, std::size_t index,
                                           std::string& type) {
  const Json images = document.json.value("images", Json::array());
  if (index >= images.size() || !images[index].contains("bufferView")) return {};
  type = images[index].value("mimeType", std::string());
  if (type != "image/png" && type != "image/jpeg") return {};
  const Json& view = document.json.at("bufferViews").at(images[index]["bufferView"].get<std::size_t>());
  return std::span(document.bin)
      .subspan(view.value("byteOffset", std::size_t{0}), view.at("byteLength").get<std::size_t>());
}

class Surfaces {
 public:
  Surfaces(const PageContents& contents, PageScene& page) : contents_(contents), page_(page) {}

  Json describe(const Surface& surface) {
    Json uniforms = Json::object(), textures = Json::array(), features = Json::array();
    const Features all = featuresOf(surface);
    setMaterial(surface, all, [&](const char* name, const auto& value) { uniforms[name] = jsonOf(value); });
    for (const SlotNames& names : slotNames()) {
      if (!all.has(names.feature)) continue;
      const SurfaceTexture& texture = surface.at(names.slot);
      uniforms[names.u] = jsonOf(textureRow(texture.use, 0));
      uniforms[names.v] = jsonOf(textureRow(texture.use, 1));
      std::string name = names.u;
      name.back() = 'T';
      if (surface.has(names.slot))
        textures.push_back({{"name", name + "exture"}, {"texture", numberOf(texture)}});
    }
    for (int i = 0; i < featureCount; ++i)
      if (all.has(static_cast<Feature>(i))) features.push_back(nameOf(static_cast<Feature>(i)));
    return {{"uniforms", uniforms},
            {"textures", textures},
            {"features", features},
            {"blended", surface.isBlended()},
            {"doubleSided", surface.material.doubleSided}};
  }

  const Json& textures() const { return textures_; }
  const Json& images() const { return images_; }

 private:
  std::size_t numberOf(const SurfaceTexture& texture) {
    const TextureRef& use = texture.use;
    const Json description = {{"image", imageOf(use.image)},
                              {"srgb", texture.srgb},
                              {"wrap", {static_cast<int>(use.wrapS), static_cast<int>(use.wrapT)}},
                              {"nearest", use.filter == TextureFilter::Nearest}};
    for (std::size_t i = 0; i < textures_.size(); ++i)
      if (textures_[i] == description) return i;
    textures_.push_back(description);
    return textures_.size() - 1;
  }

  std::size_t imageOf(int index) {
    const auto known = imageNumbers_.find(index);
    if (known != imageNumbers_.end()) return known->second;
    const std::size_t number = images_.size();
    const std::string array = "image" + std::to_string(number);
    std::string type;
    const auto bytes = encodedImage(contents_.document, static_cast<std::size_t>(index), type);
    if (!bytes.empty()) {
      page_.data.addBytes(array, bytes);
    } else {
      type = "image/png";
      page_.data.addBytes(array, encodePng(contents_.inputs.scene.images[static_cast<std::size_t>(index)],
                                           PngChannels::Rgba));
    }
    images_.push_back({{"array", array}, {"type", type}});
    imageNumbers_[index] = number;
    return number;
  }

  const PageContents& contents_;
  PageScene& page_;
  Json textures_ = Json::array(), images_ = Json::array();
  std::map<int, std::size_t> imageNumbers_;
};

/// Adds tables of what rough lobes reflect, where a surface has some, and tells the surfaces where theirs
/// begin.
void addAlbedos(const CompiledScene& compiled, std::vector<Surface>& surfaces, PageData& data) {
  const SceneAlbedos albedos = surfaceAlbedos(compiled, surfaces);
  if (!albedos.texels.empty()) data.addFloats("albedos", std::span<const glm::vec4>(albedos.texels));
}

}  // namespace

void addSurfaces(const PageContents& contents, PageScene& page) {
  std::vector<Surface> surfaces = surfacesOf(contents.inputs);
  addAlbedos(contents.inputs.compiled, surfaces, page.data);
  Surfaces described(contents, page);
  Json list = Json::array(), batches = Json::array();
  for (const Surface& surface : surfaces) list.push_back(described.describe(surface));
  for (const Batch& batch : batchesOf(contents.inputs.compiled, surfaces))
    batches.push_back({{"surface", batch.surface},
                       {"firstTriangle", batch.firstTriangle},
                       {"triangleCount", batch.triangleCount},
                       {"center", numbersOf(batch.center)}});
  page.description["surfaces"] = list;
  page.description["batches"] = batches;
  page.description["textures"] = described.textures();
  page.description["images"] = described.images();
}

}  // namespace prelight::viewer
