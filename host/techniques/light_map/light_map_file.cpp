#include "techniques/light_map/light_map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/atomic_file.h"
#include "base/magnitudes.h"
#include "charts/make_light_map_layout.h"
#include "encodings/registry/registry.h"
#include "images/add_picture.h"
#include "images/pixels.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "prelight/error.h"
#include "scene/gltf/load/file_triangles.h"
#include "scene/gltf/uri.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr int floatType = 5126, longType = 5125;
constexpr std::array<const char*, 4> radianceLayers = {"sh.l0m0", "sh.l1m-1", "sh.l1m0", "sh.l1m1"};
constexpr std::array<const char*, 3> channelNames = {"R", "G", "B"};
constexpr std::array<const char*, 3> wallLayers = {"walls.right", "walls.below", "walls.inside"};

/// The channel of a number that encoded light has of every texel.
std::string encodedLayer(std::string_view encoding, std::size_t value) {
  return fmt::format("encoded.{}.{:03}", encoding, value);
}

/// Texture coordinates of one side of a primitive's instances.
struct SideCoords {
  std::vector<glm::vec2> coords;       ///< [vertex], or [entry]
  std::vector<std::uint32_t> indices;  ///< [triangle of the file][3], into coords; empty: by vertex
};

bool hasChart(const LightMapLayout& layout, const PrimitiveRanges& ranges, std::size_t firstFace) {
  for (const PrimitiveRange& range : ranges)
    for (std::uint32_t t = 0; t < range.triangleCount; ++t)
      if (layout.chartOf[firstFace + range.firstTriangle + t] != LightMapLayout::noChart) return true;
  return false;
}

class LightMapEmbedder {
 public:
  LightMapEmbedder(GltfDocument& document, const CompiledScene& scene, const LightMapLayout& layout)
      : document_(document), scene_(scene), layout_(layout), size_(layout.width, layout.height) {}

  /// Member `lightmap`, or null when no face has a chart.
  Json entry(const PrimitiveRanges& ranges, const std::string& image) {
    if (!hasChart(layout_, ranges, 0)) return nullptr;
    Json json = sideEntry(ranges, 0, image);
    if (hasChart(layout_, ranges, scene_.triangleCount()))
      json["back"] = sideEntry(ranges, scene_.triangleCount(), image);
    return json;
  }

 private:
  Json sideEntry(const PrimitiveRanges& ranges, std::size_t firstFace, const std::string& image) {
    SideCoords side;
    if (!byVertex(ranges, firstFace, side)) byCorner(ranges, firstFace, side);
    Json json = {{"texCoord", appendAccessor(document_, std::as_bytes(std::span(side.coords)), "VEC2",
                                             floatType, side.coords.size())},
                 {"image", image}};
    if (!side.indices.empty())
      json["indices"] = appendAccessor(document_, std::as_bytes(std::span(side.indices)), "SCALAR", longType,
                                       side.indices.size());
    return json;
  }

  glm::vec2 coordOf(std::size_t face, std::size_t corner) const {
    return layout_.corners[3 * face + corner] / size_;
  }

  /// False when a vertex has several places.
  bool byVertex(const PrimitiveRanges& ranges, std::size_t firstFace, SideCoords& side) const {
    constexpr glm::vec2 unknown(-1.0f);
    for (const PrimitiveRange& range : ranges) {
      const std::size_t first = side.coords.size();
      side.coords.resize(first + range.vertexCount, unknown);
      for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
        if (layout_.chartOf[firstFace + t] == LightMapLayout::noChart) continue;
        for (int corner = 0; corner < 3; ++corner) {
          glm::vec2& known = side.coords[first + scene_.triangles[t][corner] - range.firstVertex];
          const glm::vec2 coord = coordOf(firstFace + t, static_cast<std::size_t>(corner));
          if (known != unknown && known != coord) return false;
          known = coord;
        }
      }
    }
    for (glm::vec2& coord : side.coords)
      if (coord == unknown) coord = glm::vec2(0.0f);
    return true;
  }

  void byCorner(const PrimitiveRanges& ranges, std::size_t firstFace, SideCoords& side) {
    side = {};
    for (const PrimitiveRange& range : ranges) {
      const FileTriangles file = triangles_.of(range);
      std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> entryOf;
      for (std::size_t t = 0; t < file.corners.size(); ++t)
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const glm::vec2 coord = cornerPlace(layout_, file, firstFace, t, corner).value_or(glm::vec2(0.0f));
          const std::uint32_t vertex = file.corners[t][static_cast<int>(corner)];
          const auto [found, fresh] =
              entryOf.try_emplace({vertex, coord.x, coord.y}, static_cast<std::uint32_t>(side.coords.size()));
          if (fresh) side.coords.push_back(coord);
          side.indices.push_back(found->second);
        }
    }
  }

  GltfDocument& document_;
  const CompiledScene& scene_;
  const LightMapLayout& layout_;
  glm::vec2 size_;
  FileTrianglesFinder triangles_{document_, scene_};
};

/// Turns a name into a URI's path: everything but unreserved characters in percent.
std::string percentEncode(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '-' || c == '.' || c == '_' || c == '~')
      result += c;
    else
      result += fmt::format("%{:02X}", byte);
  }
  return result;
}

class LightMapReader {
 public:
  LightMapReader(const GltfDocument& document, const JsonCursor& root, const CompiledScene& scene)
      : document_(document), values_(document, root), scene_(scene), triangles_(document, scene) {
    const std::size_t faces = 2 * std::size_t{scene.triangleCount()};
    map_.layout.corners.assign(3 * faces, glm::vec2(0.0f));
    map_.layout.chartOf.assign(faces, LightMapLayout::noChart);
  }

  void read(const JsonCursor& json, const PrimitiveRanges& ranges) {
    readSide(json, ranges, 0);
    if (const auto back = json.find("back")) readSide(*back, ranges, scene_.triangleCount());
  }

  std::optional<LightMap> finish() {
    if (image_.empty()) return std::nullopt;
    findChartsAndTexels(scene_, map_.layout);
    return std::move(map_);
  }

 private:
  void readSide(const JsonCursor& json, const PrimitiveRanges& ranges, std::size_t firstFace) {
    json.expectObject();
    readImage(json.at("image"));
    const auto indices = json.find("indices");
    const std::optional<std::size_t> count = indices ? std::nullopt : std::optional(vertexCount(ranges));
    const JsonCursor reference = json.at("texCoord");
    const std::vector<float> coords = values_.floats(reference, "VEC2", count);
    for (const float value : coords)
      if (value < 0.0f || value > 1.0f)
        reference.fail(fmt::format("got the coordinate {:g}, expected 0..1", value), rebake);
    if (indices)
      setByCorner(ranges, firstFace, coords, *indices);
    else
      setByVertex(ranges, firstFace, coords);
  }

  /// The same of all primitives.
  void readImage(const JsonCursor& uri) {
    const std::string& text = uri.asString();
    if (!image_.empty() && text != image_)
      uri.fail(fmt::format("got \"{}\", expected \"{}\" as on the other primitives", text, image_), rebake);
    if (!image_.empty()) return;
    if (text.empty() || isDataUri(text) || uriScheme(text).size() > 1)
      uri.fail("expected the name of an .exr file beside this one", rebake);
    image_ = text;
    readPicture(referencedFile(document_, uri));
  }

  void readPicture(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
      throw InputError(
          path.string(),
          fmt::format("no such file; it is the light map of {}", document_.path.filename().string()),
          "keep the two files together, or bake the scene again");
    const PictureLayers layers = readPictureLayers(path);
    map_.layout.width = layers.width;
    map_.layout.height = layers.height;
    std::vector<std::string> names = {""};
    if (layers.find(std::string(radianceLayers[0]) + ".R") != nullptr) {
      map_.coefficients = 5;
      for (const char* layer : radianceLayers) names.push_back(std::string(layer) + ".");
    }
    const auto length = static_cast<std::size_t>(map_.coefficients);
    map_.values.assign(map_.layout.texelCount() * 3 * length, 0.0f);
    for (std::size_t i = 0; i < length; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::vector<float>& channel = channelOf(path, layers, names[i] + channelNames[c], i == 0);
        for (std::size_t texel = 0; texel < channel.size(); ++texel)
          map_.values[(3 * texel + c) * length + i] = channel[texel];
      }
    readWalls(path, layers);
    readEncoded(path, layers);
  }

  void readWalls(const std::filesystem::path& path, const PictureLayers& layers) {
    if (layers.find(wallLayers[0]) == nullptr) return;
    std::vector<LightMapLayout::Wall>& walls = map_.layout.walls;
    walls.resize(map_.layout.texelCount());
    for (const char* name : wallLayers) {
      const std::vector<float>& channel = channelOf(path, layers, name, true);
      for (std::size_t texel = 0; texel < channel.size(); ++texel) {
        if (channel[texel] > LightMapLayout::noWall)
          throw InputError(path.string(),
                           fmt::format("channel {} of texel {}, {} is {}, expected 0 to {}", name,
                                       texel % static_cast<std::size_t>(layers.width),
                                       texel / static_cast<std::size_t>(layers.width), channel[texel],
                                       LightMapLayout::noWall),
                           rebake);
        if (name == wallLayers[0]) walls[texel].right = channel[texel];
        if (name == wallLayers[1]) walls[texel].below = channel[texel];
        if (name == wallLayers[2]) walls[texel].inside = channel[texel] != 0.0f;
      }
    }
  }

  /// Light of texels in every encoding whose first channel is there.
  void readEncoded(const std::filesystem::path& path, const PictureLayers& layers) {
    for (const Encoding& encoding : encodings()) {
      if (layers.find(encodedLayer(encoding.name, 0)) == nullptr) continue;
      EncodedLight light{std::string(encoding.name),
                         std::vector<float>(map_.layout.texelCount() * encoding.values)};
      for (std::size_t i = 0; i < encoding.values; ++i) {
        const std::vector<float>& channel = channelOf(path, layers, encodedLayer(encoding.name, i), false);
        for (std::size_t texel = 0; texel < channel.size(); ++texel)
          light.values[texel * encoding.values + i] = channel[texel];
      }
      map_.encoded.push_back(std::move(light));
    }
  }

  /// Numbers of a channel, which must be there.
  static const std::vector<float>& channelOf(const std::filesystem::path& path, const PictureLayers& layers,
                                             std::string_view name, bool positive) {
    const PictureChannel* channel = layers.find(name);
    if (channel == nullptr)
      throw InputError(path.string(), fmt::format("there is no channel {}", name), rebake);
    for (std::size_t texel = 0; texel < channel->values.size(); ++texel) {
      const float value = channel->values[texel];
      if (!(std::abs(value) <= largestBaked) || (positive && value < 0.0f))
        throw InputError(path.string(),
                         fmt::format("channel {} of texel {}, {} is {}, expected a number of at most {:g}{}",
                                     name, texel % static_cast<std::size_t>(layers.width),
                                     texel / static_cast<std::size_t>(layers.width), value, largestBaked,
                                     positive ? " not below 0" : ""),
                         rebake);
    }
    return channel->values;
  }

  void setCorner(std::size_t face, std::size_t corner, const glm::vec2& coord) {
    map_.layout.corners[3 * face + corner] = coord * glm::vec2(map_.layout.width, map_.layout.height);
    map_.layout.chartOf[face] = 0;
  }

  void setByVertex(const PrimitiveRanges& ranges, std::size_t firstFace, const std::vector<float>& coords) {
    std::size_t first = 0;
    for (const PrimitiveRange& range : ranges) {
      for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t)
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const std::size_t at = first + scene_.triangles[t][static_cast<int>(corner)] - range.firstVertex;
          setCorner(firstFace + t, corner, {coords[2 * at], coords[2 * at + 1]});
        }
      first += range.vertexCount;
    }
  }

  void setByCorner(const PrimitiveRanges& ranges, std::size_t firstFace, const std::vector<float>& coords,
                   const JsonCursor& reference) {
    std::vector<FileTriangles> files;
    std::size_t count = 0;
    for (const PrimitiveRange& range : ranges) {
      files.push_back(triangles_.of(range));
      count += 3 * files.back().corners.size();
    }
    const std::vector<std::uint32_t> indices = values_.integers<std::uint32_t>(reference, count);
    std::size_t next = 0;
    for (const FileTriangles& file : files)
      for (std::size_t t = 0; t < file.compiled.size(); ++t)
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const std::size_t at = indices[next++];
          if (2 * at + 1 >= coords.size())
            reference.fail(fmt::format("index {} of {} texture coordinates", at, coords.size() / 2), rebake);
          if (file.compiled[t] == FileTriangles::dropped) continue;
          setCorner(firstFace + file.compiled[t], file.compiledCorner(t, corner),
                    {coords[2 * at], coords[2 * at + 1]});
        }
  }

  const GltfDocument& document_;
  ValueReader values_;
  const CompiledScene& scene_;
  FileTrianglesFinder triangles_;
  std::string image_;
  LightMap map_;
};

}  // namespace

std::filesystem::path lightMapPath(const std::filesystem::path& baked) {
  std::filesystem::path path = baked;
  return path.replace_extension(".lightmap.exr");
}

void embedLightMap(GltfDocument& document, const CompiledScene& scene, const LightMapLayout& layout,
                   const std::string& image) {
  LightMapEmbedder embedder(document, scene, layout);
  for (const auto& [key, ranges] : groupRanges(scene)) {
    Json entry = embedder.entry(ranges, percentEncode(image));
    if (entry.is_null()) continue;
    Json& extension =
        document.json["nodes"][static_cast<std::size_t>(key.first)]["extensions"]["PRELIGHT_transfer"];
    extension["primitives"][static_cast<std::size_t>(key.second)]["lightmap"] = std::move(entry);
  }
}

void writeLightMap(const std::filesystem::path& path, const LightMap& map) {
  OutputFiles files;
  addLightMap(files, path, map);
  files.commit();
}

Picture irradianceOf(const LightMap& map) {
  const auto length = static_cast<std::size_t>(map.coefficients);
  Picture picture{map.layout.width, map.layout.height, {}};
  for (std::size_t texel = 0; texel < map.layout.texelCount(); ++texel) {
    const float* values = &map.values[3 * length * texel];
    picture.pixels.emplace_back(values[0], values[length], values[2 * length]);
  }
  return picture;
}

namespace {

void addWalls(const LightMapLayout& layout, std::vector<PictureChannel>& channels) {
  for (const char* name : wallLayers) channels.push_back({name, {}});
  for (const LightMapLayout::Wall& wall : layout.walls) {
    channels[channels.size() - 3].values.push_back(wall.right);
    channels[channels.size() - 2].values.push_back(wall.below);
    channels.back().values.push_back(wall.inside ? 1.0f : 0.0f);
  }
}

}  // namespace

void addLightMap(OutputFiles& files, const std::filesystem::path& path, const LightMap& map) {
  const auto length = static_cast<std::size_t>(map.coefficients);
  std::vector<PictureChannel> channels;
  for (std::size_t i = 1; i < length; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      PictureChannel channel{fmt::format("{}.{}", radianceLayers[i - 1], channelNames[c]), {}};
      for (std::size_t texel = 0; texel < map.layout.texelCount(); ++texel)
        channel.values.push_back(map.values[(3 * texel + c) * length + i]);
      channels.push_back(std::move(channel));
    }
  for (const EncodedLight& light : map.encoded) {
    const std::size_t count = light.values.size() / std::max<std::size_t>(1, map.layout.texelCount());
    for (std::size_t i = 0; i < count; ++i) {
      PictureChannel channel{encodedLayer(light.encoding, i), {}};
      for (std::size_t at = i; at < light.values.size(); at += count)
        channel.values.push_back(light.values[at]);
      channels.push_back(std::move(channel));
    }
  }
  if (!map.layout.walls.empty()) addWalls(map.layout, channels);
  addPicture(files, path, irradianceOf(map), channels);
}

std::optional<LightMap> readLightMap(const GltfDocument& document, const JsonCursor& root,
                                     const CompiledScene& scene) {
  std::optional<LightMapReader> reader;
  for (const auto& [key, ranges] : groupRanges(scene)) {
    const auto extension = transferExtension(root.at("nodes").at(static_cast<std::size_t>(key.first)));
    const auto primitives = extension ? extension->find("primitives") : std::nullopt;
    if (!primitives || static_cast<std::size_t>(key.second) >= primitives->arraySize()) continue;
    const auto entry = primitives->at(static_cast<std::size_t>(key.second)).find("lightmap");
    if (!entry || vertexCount(ranges) == 0) continue;
    if (!reader) reader.emplace(document, root, scene);
    reader->read(*entry, ranges);
  }
  return reader ? reader->finish() : std::nullopt;
}

}  // namespace prelight
