#include "export/exported_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "export/exported_animations.h"
#include "export/prefiltered_sky.h"
#include "export/texel_codes.h"
#include "images/picture_codecs.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 2> lightExtensions = {"KHR_lights_punctual", "EXT_lights_ies"};

void dropExtension(Json& object, const char* name) {
  if (!object.contains("extensions")) return;
  object["extensions"].erase(name);
  if (object["extensions"].empty()) object.erase("extensions");
}

/// Marks a light in its extras. Extras that are no object belong to the scene and stay unchanged.
void mark(Json& light) {
  Json& extras = light["extras"];
  if (!extras.is_null() && !extras.is_object()) return;
  Json& own = extras["prelight"];
  if (own.is_null() || own.is_object()) own["baked"] = true;
}

void removeLights(Json& root, const char* extension) {
  for (Json& node : root["nodes"]) dropExtension(node, extension);
  dropExtension(root, extension);
  dropExtensionName(root, extension);
  const std::string path = std::string("/extensions/") + extension + "/";
  dropChannels(root, [&](const std::string& pointer) { return pointer.find(path) != std::string::npos; });
}

}  // namespace

std::size_t exportLights(GltfDocument& document, BakedLights lights) {
  Json& root = document.json;
  std::size_t count = 0;
  for (const char* extension : lightExtensions) {
    const Json::json_pointer list(std::string("/extensions/") + extension + "/lights");
    if (!root.contains(list)) continue;
    count += root[list].size();
    if (lights == BakedLights::Remove) removeLights(root, extension);
    if (lights != BakedLights::Mark) continue;
    for (Json& light : root[list]) mark(light);
  }
  return count;
}

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* skyExtension = "EXT_lights_image_based";

/// Coefficients that are odd in z: the extension's cube is looked up with (x, y, -z) of a direction
/// (docs/conventions.md).
constexpr std::array<std::size_t, 3> oddInZ = {2, 5, 7};

/// Returns the picture of a face, with rows from bottom to top.
Picture facePicture(const CubeMap& map, int face) {
  Picture picture{map.faceSize, map.faceSize, {}};
  for (int row = map.faceSize - 1; row >= 0; --row)
    for (int column = 0; column < map.faceSize; ++column) {
      const auto texel = static_cast<std::uint32_t>((face * map.faceSize + row) * map.faceSize + column);
      const glm::dvec3 d = cubeTexelDirection(texel, map.faceSize);
      picture.pixels.push_back(map.radiance[cubeTexel({d.x, d.y, -d.z}, map.faceSize)]);
    }
  return picture;
}

/// Returns the divisor of the pictures: the mean, so that most of the sky has fine steps, or what the
/// brightest texel requires.
float intensityOf(const CubeMap& map) {
  glm::dvec3 sum(0.0);
  float largest = 0.0f;
  for (const glm::vec3& texel : map.radiance) {
    sum += glm::dvec3(texel);
    largest = std::max({largest, texel.x, texel.y, texel.z});
  }
  const double mean = (sum.x + sum.y + sum.z) / (3.0 * static_cast<double>(map.radiance.size()));
  const double intensity = std::max(mean, largest / rgbdSteps);
  return intensity > 0.0 ? static_cast<float>(intensity) : 1.0f;
}

int addImage(GltfDocument& document, const std::string& name, const Picture& picture, float intensity) {
  const CodedPicture coded = encodeTexels(picture, TexelCode::Rgbd, intensity);
  document.json["images"].push_back(
      {{"name", name},
       {"mimeType", "image/png"},
       {"bufferView", appendBufferView(document, encodePng(coded.image, PngChannels::Rgba))}});
  return static_cast<int>(document.json["images"].size()) - 1;
}

Json coefficientsOf(const PrefilteredSky& sky, float intensity) {
  Json coefficients = Json::array();
  for (std::size_t i = 0; i < sky.irradiance.size(); ++i) {
    const bool turned = std::find(oddInZ.begin(), oddInZ.end(), i) != oddInZ.end();
    const glm::dvec3 value = sky.irradiance[i] * ((turned ? -1.0 : 1.0) / static_cast<double>(intensity));
    coefficients.push_back({value.x, value.y, value.z});
  }
  return coefficients;
}

}  // namespace

std::size_t addSky(GltfDocument& document, const Environment& sky) {
  const PrefilteredSky filtered = prefilterSky(sky);
  const float intensity = intensityOf(filtered.levels[0]);
  Json levels = Json::array();
  std::size_t pictures = 0;
  for (std::size_t level = 0; level < filtered.levels.size(); ++level) {
    Json faces = Json::array();
    for (int face = 0; face < cubeFaces; ++face, ++pictures)
      faces.push_back(addImage(document, fmt::format("sky {} {}", level, face),
                               facePicture(filtered.levels[level], face), intensity));
    levels.push_back(std::move(faces));
  }
  Json& root = document.json;
  Json& lights = root["extensions"][skyExtension]["lights"];
  lights.push_back({{"name", "sky"},
                    {"intensity", intensity},
                    {"rotation", {0, 0, 0, 1}},
                    {"irradianceCoefficients", coefficientsOf(filtered, intensity)},
                    {"specularImageSize", filtered.levels[0].faceSize},
                    {"specularImages", std::move(levels)}});
  const std::size_t light = lights.size() - 1;
  Json& scene = root["scenes"][root.value("scene", std::size_t{0})];
  scene["extensions"][skyExtension]["light"] = light;
  useExtensionName(root, skyExtension);
  return pictures;
}

void exportSkies(GltfDocument& document, BakedLights asked) {
  const Json::json_pointer list(std::string("/extensions/") + skyExtension + "/lights");
  if (asked == BakedLights::Keep || !document.json.contains(list)) return;
  for (Json& light : document.json[list]) {
    if (!light.contains("irradianceCoefficients")) continue;
    Json& extras = light["extras"];
    if (extras.is_null() || extras.is_object()) {
      extras["prelight"]["baked"] = true;
      extras["prelight"]["irradianceCoefficients"] = light["irradianceCoefficients"];
    }
    if (asked == BakedLights::Mark) continue;
    for (Json& coefficient : light["irradianceCoefficients"]) coefficient = {0.0, 0.0, 0.0};
  }
}

}  // namespace prelight
