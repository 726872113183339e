#include "export/export_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <span>

#include "base/atomic_file.h"
#include "charts/make_light_map_layout.h"
#include "export/export_readme.h"
#include "export/exported_lights.h"
#include "export/half_ktx2.h"
#include "export/map_picture.h"
#include "export/raw_arrays.h"
#include "export/texel_codes.h"
#include "images/add_picture.h"
#include "images/picture_codecs.h"
#include "io/baked_file.h"
#include "io/baked_strip.h"
#include "io/values/value_reader.h"
#include "prelight/error.h"
#include "scene/gltf/document_references.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

class Exporter {
 public:
  Exporter(ExportedScene& exported, const std::filesystem::path& output, const std::string& name,
           const ExportRequest& request)
      : exported_(exported),
        request_(request),
        folder_(output.extension() != ".glb"),
        output_(output),
        name_(name),
        files_(folder_ ? output : std::filesystem::path(), workOf(request)) {}

  ExportReport run() {
    GltfDocument& document = exported_.document;
    makePicture();
    stripBake(document);
    report_.contents = exportedContents(exported_.bake, exported_.compiled.vertexCount(), request_);
    if (keepsTransfer()) {
      embedBake(document, exported_.compiled, relitParts(exported_.bake));
      report_.lights = exportLights(document, BakedLights::Keep);
    } else {
      changeScene();
    }
    if (request_.form == ExportForm::LightMap && folder_) addMaps();
    const std::filesystem::path glb = folder_ ? output_ / (name_ + ".glb") : output_;
    addGlb(files_, glb, document);
    tell(glb.filename().string(), "the scene, glTF 2.0");
    if (folder_ && request_.target == ExportTarget::Raw) addVertices();
    if (folder_) addTexts();
    for (ExportedFile& file : report_.files)
      file.bytes = files_.bytesOf(folder_ ? output_ / file.name : output_);
    files_.commit();
    return report_;
  }

 private:
  /// Returns whether the scene stays as it is, with the transfer in the file's own extension.
  bool keepsTransfer() const {
    return request_.form == ExportForm::Transfer && request_.target == ExportTarget::Three;
  }

  void changeScene() {
    GltfDocument& document = exported_.document;
    dropExtensionName(document.json, transferExtensionName);
    report_.meshes =
        exportMeshes(document, exported_.scene, exported_.compiled, exported_.bake, request_, mapsOf());
    report_.lights = exportLights(document, holdsLight(request_.form) ? request_.lights : BakedLights::Keep);
    if (exported_.sky != nullptr) report_.skyPictures = addSky(document, *exported_.sky);
    if (holdsLight(request_.form)) exportSkies(document, request_.lights);
    removeUnused(document);
  }

  void tell(const std::string& name, const std::string& contents) {
    report_.files.push_back({name, contents, {}});
  }

  /// Makes the picture, for forms that have a map.
  void makePicture() {
    const Bake& bake = exported_.bake;
    if (request_.form == ExportForm::LightMap) {
      layout_ = &bake.lightMap->layout;
      plainMap_ = withoutWalls(*bake.lightMap);
      picture_ = irradiancePicture(plainMap_);
      report_.directions = hasDirections(plainMap_);
      if (report_.directions) directions_ = radianceMaps(plainMap_);
    } else if (request_.form == ExportForm::Occlusion) {
      layout_ = &exported_.occlusion->layout;
      plainMap_ = withoutWalls(*exported_.occlusion);
      picture_ = occlusionPicture(plainMap_);
    }
    if (!picture_) return;
    report_.mapWidth = picture_->width;
    report_.mapHeight = picture_->height;
    for (const glm::vec3& pixel : picture_->pixels)
      report_.largest = std::max({report_.largest, pixel.x, pixel.y, pixel.z});
  }

  /// Returns whether the target's programs know MOZ_lightmap; others would load its picture in vain.
  bool readsMaps() const {
    return request_.target == ExportTarget::Gltf || request_.target == ExportTarget::Three ||
           request_.target == ExportTarget::Raw;
  }

  /// Adds the map's textures to the document and returns them.
  ChartMaps mapsOf() {
    ChartMaps maps{layout_, {}, {}};
    if (!picture_ || (request_.form == ExportForm::LightMap && !readsMaps())) return maps;
    if (request_.form == ExportForm::LightMap) maps.ranges = findChartRanges(*picture_, *layout_);
    for (int range = 0; range < maps.ranges.count; ++range)
      maps.textures.push_back(addTexture(pictureOfRange(*picture_, *layout_, maps.ranges, range)));
    report_.mapPictures = maps.ranges.count;
    return maps;
  }

  ChartTexture addTexture(const Picture& picture) {
    const CodedPicture coded = encodeTexels(picture, TexelCode::Scaled);
    GltfDocument& document = exported_.document;
    Json& json = document.json;
    json["images"].push_back(
        {{"name", fmt::format("{} {}", name_, holdsLight(request_.form) ? "light map" : "occlusion")},
         {"mimeType", "image/png"},
         {"bufferView", appendBufferView(document, encodePng(coded.image))}});
    constexpr int linear = 9729, clampToEdge = 33071;
    // No mipmaps: charts lie closely packed, and coarser levels would mix them.
    json["samplers"].push_back(
        {{"magFilter", linear}, {"minFilter", linear}, {"wrapS", clampToEdge}, {"wrapT", clampToEdge}});
    json["textures"].push_back(
        {{"source", json["images"].size() - 1}, {"sampler", json["samplers"].size() - 1}});
    return {static_cast<int>(json["textures"].size()) - 1, coded.scale};
  }

  void addBytes(const std::string& name, std::span<const std::uint8_t> bytes, const std::string& contents) {
    files_.add(output_ / name, std::as_bytes(bytes));
    tell(name, contents);
  }

  void addMaps() {
    const std::string stem = name_ + ".lightmap";
    const ExportTarget target = request_.target;
    addExr(stem);
    if (report_.directions && (target == ExportTarget::Gltf || target == ExportTarget::Unity))
      addDirectionImage(stem);
    if (target != ExportTarget::Gltf && target != ExportTarget::Three) return;
    addBytes(stem + ".ktx2", encodeHalfKtx2(*picture_), "irradiance, W/m2, RGBA halves, uncompressed");
    addDirections(stem);
    if (target != ExportTarget::Gltf) return;
    const CodedPicture rgbm = encodeTexels(*picture_, TexelCode::Rgbm);
    addBytes(stem + ".rgbm.png", encodePng(rgbm.image, PngChannels::Rgba),
             fmt::format("irradiance / (W/m2) = {:.9g} (8 a rgb)^2", rgbm.scale));
    const CodedPicture rgbd = encodeTexels(*picture_, TexelCode::Rgbd);
    addBytes(stem + ".rgbd.png", encodePng(rgbd.image, PngChannels::Rgba),
             fmt::format("irradiance / (W/m2) = {:.9g} rgb^2.2 / a", rgbd.scale));
  }

  /// Adds the map as .exr, with layers of directions if the map has them.
  void addExr(const std::string& stem) {
    std::vector<PictureChannel> layers;
    for (std::size_t i = 0; i < directions_.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        PictureChannel layer{fmt::format("{}.{}", radianceMapNames[i], "RGB"[c]), {}};
        for (const glm::vec3& pixel : directions_[i].pixels) layer.values.push_back(pixel[c]);
        layers.push_back(std::move(layer));
      }
    Picture picture = *picture_;
    const bool overPi = request_.target == ExportTarget::Unity;
    if (overPi)
      for (glm::vec3& pixel : picture.pixels) pixel *= std::numbers::inv_pi_v<float>;
    addPicture(files_, output_ / (stem + ".exr"), picture, layers);
    tell(stem + ".exr",
         fmt::format("{}{}, floats", overPi ? "irradiance / pi, W/(m2 sr)" : "irradiance, W/m2",
                     directions_.empty() ? "" : ", and layers of incident radiance"));
  }

  void addDirectionImage(const std::string& stem) {
    Image image = directionImage(exported_.compiled, plainMap_);
    // glTFast converts scenes to Unity's left-handed space by negating x.
    if (request_.target == ExportTarget::Unity)
      for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        image.rgba[i] = static_cast<std::uint8_t>(255 - image.rgba[i]);
    addBytes(stem + ".direction.png", encodePng(image, PngChannels::Rgba),
             "dominant direction, and its half Lambert on the surface's normal");
  }

  void addDirections(const std::string& stem) {
    for (std::size_t i = 0; i < directions_.size(); ++i)
      addBytes(fmt::format("{}.{}.ktx2", stem, radianceMapNames[i]), encodeHalfKtx2(directions_[i]),
               "incident radiance in a function of SH, W/(m2 sr), RGBA halves");
  }

  void addVertices() {
    RawArrays arrays;
    Json description = addRawVertices(exported_.compiled, exported_.bake, arrays);
    if (arrays.json().empty()) return;
    const std::string stem = name_ + ".vertices";
    description["file"] = stem + ".bin";
    description["arrays"] = arrays.json();
    addBytes(stem + ".bin", arrays.bytes(), "baked data of the vertices, as numbers");
    const std::string text = description.dump(2) + "\n";
    files_.add(output_ / (stem + ".json"), std::as_bytes(std::span(text)));
    tell(stem + ".json", "layout of its contents, for programs");
  }

  void addTexts() {
    for (const TextFile& text : exportTexts(name_, report_, request_)) {
      files_.add(output_ / text.name, std::as_bytes(std::span(text.text)));
      tell(text.name, text.contents);
    }
    const std::string description = name_ + ".export.json";
    tell(description, "this list, for programs");
    const std::string text = toJson(report_, request_).dump(2) + "\n";
    files_.add(output_ / description, std::as_bytes(std::span(text)));
  }

  ExportedScene& exported_;
  const ExportRequest& request_;
  bool folder_;
  const std::filesystem::path& output_;
  const std::string& name_;
  std::optional<Picture> picture_;   ///< picture of the map, if the form has one
  std::vector<Picture> directions_;  ///< radianceMaps(), where the light map has directions
  LightMap plainMap_;                ///< the map that is exported, withoutWalls()
  const LightMapLayout* layout_ = nullptr;
  OutputFiles files_;
  ExportReport report_;
};

}  // namespace

ExportForm usualForm(const Bake& bake, ExportTarget target) {
  if (target == ExportTarget::Three && isRelit(bake)) return ExportForm::Transfer;
  if (bake.lightMap) return ExportForm::LightMap;
  if (!bake.ao.empty()) return ExportForm::Occlusion;
  return target == ExportTarget::Raw ? ExportForm::Transfer : ExportForm::LightMap;
}

void requireTarget(ExportForm form, ExportTarget target) {
  if (form == ExportForm::Transfer && target != ExportTarget::Raw && target != ExportTarget::Three)
    throw UsageError("ExportRequest::form transfer", "transfer is exported only as numbers and for three.js",
                     "give ExportRequest::target raw or three");
}

void requireForm(const Bake& bake, ExportForm form, ExportTarget target) {
  const auto expect = [&](bool holds, const char* what, const char* fix) {
    if (holds) return;
    throw UsageError(fmt::format("ExportRequest::form {}", exportFormNames[static_cast<std::size_t>(form)]),
                     fmt::format("the bake holds no {}", what), fix);
  };
  switch (form) {
    case ExportForm::LightMap:
    case ExportForm::Probes:
      return expect(bake.lightMap.has_value(), "light map", "bake with BakeRequest::lightMap");
    case ExportForm::VertexLight:
      return expect(bake.irradiance.has_value(), "irradiance of vertices",
                    "bake with BakeRequest::lightMap or BakeRequest::radiosity");
    case ExportForm::Occlusion:
    case ExportForm::VertexOcclusion:
      return expect(!bake.ao.empty(), "ambient occlusion", "bake with BakeRequest::ao");
    case ExportForm::Volume:
      return expect(bake.volume.has_value(), "volume", "bake with VolumeRequest::size");
    case ExportForm::Transfer:
      if (target == ExportTarget::Three)
        return expect(isRelit(bake), "transfer that prelight.js relights (SH, CH or light groups)",
                      "bake with ShRequest::order");
      return expect(bake.sh || bake.compressedSh || bake.ch || bake.haar || bake.occluders,
                    "transfer of vertices", "bake with ShRequest::order");
  }
}

LightMap occlusionForExport(const Scene& scene, const CompiledScene& compiled, const Bake& bake,
                            std::uint32_t rays, const Device& device, Progress& progress,
                            OcclusionMapReport& report) {
  const OcclusionMapRequest request{bake.info.limits, bake.info.shadowSets, rays, bake.info.seed};
  return makeOcclusionMap(compiled, makeLightMapLayout(scene, compiled, {}), request, device, progress,
                          report);
}

ExportReport exportBake(ExportedScene exported, const std::filesystem::path& output, const std::string& name,
                        const ExportRequest& request) {
  requireForm(exported.bake, request.form, request.target);
  if (isOfAir(request.form))
    throw UsageError(
        fmt::format("ExportRequest::form {}", exportFormNames[static_cast<std::size_t>(request.form)]),
        "it belongs to points in the air, not to the scene", "call exportProbes() or exportTransferVolume()");
  if (request.form == ExportForm::Occlusion && exported.occlusion == nullptr)
    throw UsageError("ExportedScene::occlusion", "the form is a map of occlusion, and none is given",
                     "make it with occlusionForExport()");
  return Exporter(exported, output, name, request).run();
}

namespace {

Json toJson(const ExportedFile& file) {
  Json json = {{"name", file.name}, {"contents", file.contents}};
  if (file.bytes > 0) json["bytes"] = file.bytes;
  return json;
}

}  // namespace

Json toJson(const ExportReport& report, const ExportRequest& request) {
  Json files = Json::array();
  for (const ExportedFile& file : report.files) files.push_back(toJson(file));
  Json json = {{"target", exportTargetNames[static_cast<std::size_t>(request.target)]},
               {"as", exportFormNames[static_cast<std::size_t>(request.form)]},
               {"unit", {{"length", "m"}, {"irradiance", "W/m2"}}}};
  if (!isOfAir(request.form))
    json.update({{"drawings", report.meshes.drawings},
                 {"splitVertices", report.meshes.split},
                 {"backs", report.meshes.backs},
                 {"parts", report.meshes.parts},
                 {"lights",
                  {{"count", report.lights},
                   {"asked", bakedLightsNames[static_cast<std::size_t>(request.lights)]}}}});
  json["files"] = files;
  json.update(toJson(report.contents));
  if (report.skyPictures > 0)
    json["sky"] = {{"extension", "EXT_lights_image_based"}, {"pictures", report.skyPictures}};
  if (report.mapWidth > 0)
    json["map"] = {{"width", report.mapWidth},
                   {"height", report.mapHeight},
                   {"largest", report.largest},
                   {"pictures", report.mapPictures},
                   {"directions", report.directions},
                   {"texCoord",
                    "TEXCOORD_1, or the set that a material's MOZ_lightmap or "
                    "extras.prelight_light_map names"},
                   {"layout", "rows from the top, v down; look up bilinearly, clamped, without mipmaps"}};
  if (report.occlusion)
    json["occlusion"] = {{"error", report.occlusion->error},
                         {"places", report.occlusion->places},
                         {"rays", report.occlusion->rays}};
  if (request.form == ExportForm::VertexLight) json["colorScale"] = report.meshes.colorScale;
  return json;
}

}  // namespace prelight
