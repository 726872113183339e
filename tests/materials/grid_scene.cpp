#include "materials/grid_scene.h"

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numbers>
#include <stdexcept>

#include "materials/plain_png.h"
#include "scene/gltf/gltf_embed.h"
#include "support/gltf_files.h"

namespace prelight::test {

namespace {

using Json = nlohmann::ordered_json;

struct Vertices {
  std::vector<float> positions, normals, coordinates, tangents;
  std::vector<std::uint32_t> indices;
};

void addQuads(int columns, int rows, std::vector<std::uint32_t>& indices) {
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const auto first = static_cast<std::uint32_t>(r * (columns + 1) + c);
      const auto below = first + static_cast<std::uint32_t>(columns) + 1;
      for (const std::uint32_t i : {first, below, first + 1, first + 1, below, below + 1})
        indices.push_back(i);
    }
  }
}

template <class Point>
Vertices gridOf(int columns, int rows, Point point) {
  Vertices vertices;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) point(double(c) / columns, double(r) / rows, vertices);
  addQuads(columns, rows, vertices.indices);
  return vertices;
}

void append(std::vector<float>& values, std::initializer_list<double> more) {
  for (const double value : more) values.push_back(static_cast<float>(value));
}

Vertices ball() {
  constexpr double pi = std::numbers::pi;
  return gridOf(96, 48, [](double u, double v, Vertices& to) {
    const double a = 2 * pi * u, p = pi * v;
    append(to.positions, {std::sin(p) * std::sin(a), std::cos(p), std::sin(p) * std::cos(a)});
    append(to.normals, {std::sin(p) * std::sin(a), std::cos(p), std::sin(p) * std::cos(a)});
    append(to.coordinates, {u, v});
    append(to.tangents, {std::cos(a), 0.0, -std::sin(a), 1.0});
  });
}

Vertices card() {
  return gridOf(8, 8, [](double u, double v, Vertices& to) {
    append(to.positions, {2 * u - 1, 1 - 2 * v, 0.0});
    append(to.normals, {0.0, 0.0, 1.0});
    append(to.coordinates, {u, v});
    append(to.tangents, {1.0, 0.0, 0.0, 1.0});
  });
}

using Texel = std::array<double, 4>;

/// The pictures that cells name, as functions of texture coordinates.
const std::map<std::string, std::function<Texel(double, double)>>& gridPictures() {
  constexpr double pi = std::numbers::pi;
  static const std::map<std::string, std::function<Texel(double, double)>> pictures = {
      {"colors",
       [](double u, double v) {
         return Texel{0.2 + 0.7 * u, 0.2 + 0.7 * v, (u > 0.5) != (v > 0.5) ? 0.8 : 0.3, 1.0};
       }},
      {"few",
       [](double u, double v) {
         const auto shade = [](int row, int column) { return ((row * 3 + column * 5) % 7 + 1) / 8.0; };
         const int x = static_cast<int>(4 * u), y = static_cast<int>(4 * v);
         return Texel{shade(y, x), shade(x, y), 1.0 - shade(y, x), 1.0};
       }},
      {"dots",
       [](double u, double v) {
         return Texel{0.8, 0.5, 0.2, std::hypot(u - 0.5, v - 0.5) < 0.35 ? 1.0 : 0.0};
       }},
      {"fade",
       [](double u, double) {
         return Texel{1 - u, 1 - u, 1 - u, 1 - u};
       }},
      {"metals",
       [](double u, double v) {
         return Texel{1.0, 0.2 + 0.6 * v, u > 0.5 ? 1.0 : 0.0, 1.0};
       }},
      {"bumps", [](double u, double v) {
         const glm::dvec3 n =
             glm::normalize(glm::dvec3(0.5 * std::sin(4 * pi * u), 0.3 * std::cos(4 * pi * v) + 0.2, 1.0));
         return Texel{n.x / 2 + 0.5, n.y / 2 + 0.5, n.z / 2 + 0.5, 1.0};
       }}};
  return pictures;
}

Image gridPicture(const std::string& name) {
  const int size = name == "few" ? 4 : 64;
  Image image{name, size, size, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (const double value : gridPictures().at(name)((x + 0.5) / size, (y + 0.5) / size))
        image.rgba.push_back(static_cast<std::uint8_t>(value * 255 + 0.5));
  return image;
}

int addTexture(GltfDocument& document, const std::string& name, const std::string& sampler) {
  constexpr int nearest = 9728, linear = 9729, clamp = 33071, mirror = 33648, repeat = 10497;
  const int filter = sampler == "nearest" ? nearest : linear;
  const int wrap = sampler == "clamp" ? clamp : sampler == "mirror" ? mirror : repeat;
  Json& root = document.json;
  const int view = appendBufferView(document, plainPng(gridPicture(name)));
  root["images"].push_back({{"mimeType", "image/png"}, {"bufferView", view}});
  root["samplers"].push_back(
      {{"magFilter", filter}, {"minFilter", filter}, {"wrapS", wrap}, {"wrapT", wrap}});
  root["textures"].push_back(
      {{"source", root["images"].size() - 1}, {"sampler", root["samplers"].size() - 1}});
  return static_cast<int>(root["textures"].size()) - 1;
}

/// A cell's material with names of textures replaced by the indices of textures that are added to the
/// document. Adds the extensions that it names to `extensions`.
Json resolve(GltfDocument& document, const Json& value, std::set<std::string>& extensions) {
  if (!value.is_object()) return value;
  Json out = Json::object();
  for (const auto& [key, member] : value.items()) {
    if (key.starts_with("KHR_")) extensions.insert(key);
    if (key != "texture" && key != "sampler") out[key] = resolve(document, member, extensions);
  }
  if (value.contains("texture"))
    out["index"] = addTexture(document, value["texture"], value.value("sampler", std::string("repeat")));
  return out;
}

Json matrixOf(const glm::dmat4& matrix) {
  Json out = Json::array();
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) out.push_back(matrix[column][row]);
  return out;
}

glm::dmat4 lookingFrom(const glm::dvec3& eye) {
  return glm::inverse(glm::lookAtRH(eye, glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)));
}

Json attributesOf(GltfDocument& document, const GridCell& cell, Vertices& vertices) {
  std::vector<float>& uv = vertices.coordinates;
  if (cell.attributes.contains("MIRRORED"))
    for (std::size_t i = 0; i < uv.size(); i += 2) uv[i] = std::abs(2 * uv[i] - 1);
  std::vector<float> turned, shades;
  for (std::size_t i = 0; i < uv.size(); i += 2) {
    append(turned, {uv[i + 1], 1 - uv[i]});
    append(shades, {0.2 + 0.7 * uv[i], 0.2 + 0.7 * uv[i + 1], 0.5, 1.0});
  }
  Json attributes = {{"POSITION", appendFloats(document, vertices.positions, "VEC3")},
                     {"NORMAL", appendFloats(document, vertices.normals, "VEC3")},
                     {"TEXCOORD_0", appendFloats(document, uv, "VEC2")},
                     {"TEXCOORD_1", appendFloats(document, turned, "VEC2")}};
  if (cell.attributes.contains("TANGENT"))
    attributes["TANGENT"] = appendFloats(document, vertices.tangents, "VEC4");
  if (cell.attributes.contains("COLOR_0")) attributes["COLOR_0"] = appendFloats(document, shades, "VEC4");
  return attributes;
}

void addLight(Json& root, std::set<std::string>& extensions) {
  const Json light = {{"type", "directional"}, {"intensity", 2.0}};
  root["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
  root["nodes"].push_back({{"matrix", matrixOf(lookingFrom({1.0, 2.0, 3.0}))},
                           {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  extensions.insert("KHR_lights_punctual");
}

}  // namespace

std::vector<GridCell> readGridCells() {
  std::ifstream file(GRID_CELLS);
  if (!file) throw std::runtime_error(std::string("cannot read ") + GRID_CELLS);
  std::vector<GridCell> cells;
  for (const Json& json : Json::parse(file)) {
    GridCell& cell = cells.emplace_back();
    cell.name = json["name"];
    cell.isBall = json["shape"] == "ball";
    cell.lossless = json["lossless"];
    cell.material = json["material"];
    for (const Json& name : json["attributes"]) cell.attributes.insert(name.get<std::string>());
  }
  return cells;
}

GltfDocument gridScene(const GridCell& cell, bool even) {
  GltfDocument document;
  document.path = cell.name + ".glb";
  Json& root = document.json;
  root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
  Vertices vertices = cell.isBall ? ball() : card();
  const std::span<const std::byte> indices = std::as_bytes(std::span(vertices.indices));
  const Json primitive = {
      {"attributes", attributesOf(document, cell, vertices)},
      {"indices", appendAccessor(document, indices, "SCALAR", 5125, vertices.indices.size())},
      {"material", 0}};
  root["meshes"] = Json::array({{{"primitives", Json::array({primitive})}}});
  std::set<std::string> extensions;
  Json material = resolve(document, cell.material, extensions);
  material["name"] = cell.name;
  if (!cell.isBall) material["doubleSided"] = true;
  root["materials"] = Json::array({material});
  Json node = {{"name", cell.name}, {"mesh", 0}};
  if (!cell.isBall) {
    const glm::dvec4 lean = glm::normalize(glm::dvec4(gridLean[0], gridLean[1], gridLean[2], gridLean[3]));
    node["rotation"] = {lean.x, lean.y, lean.z, lean.w};
  }
  root["nodes"] = Json::array({node});
  if (!even) addLight(root, extensions);
  root["cameras"] =
      Json::array({{{"type", "perspective"},
                    {"perspective", {{"yfov", gridYFov}, {"aspectRatio", 1.0}, {"znear", 0.01}}}}});
  root["nodes"].push_back(
      {{"camera", 0}, {"matrix", matrixOf(lookingFrom({gridEye[0], gridEye[1], gridEye[2]}))}});
  Json roots = Json::array();
  for (std::size_t i = 0; i < root["nodes"].size(); ++i) roots.push_back(i);
  root["scenes"] = Json::array({{{"nodes", roots}}});
  if (!extensions.empty()) root["extensionsUsed"] = extensions;
  return document;
}

Picture gridSky(bool even) {
  if (even) return {2, 1, {glm::vec3(1.0f), glm::vec3(1.0f)}};
  Picture sky{128, 64, {}};
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < sky.width; ++x)
      sky.pixels.push_back(
          glm::vec3(1.0 + 0.5 * Environment::direction((x + 0.5) / sky.width, (y + 0.5) / sky.height)));
  return sky;
}

}  // namespace prelight::test
