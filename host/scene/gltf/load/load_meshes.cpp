#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "prelight/error.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/load/load_parts.h"

namespace prelight {

namespace {

enum Mode : int { Triangles = 4, TriangleStrip = 5, TriangleFan = 6 };

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Returns a reader of the attribute `name`, if the primitive has it.
std::optional<AccessorReader> attributeReader(const LoadContext& context,
                                              const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  if (found == primitive.attributes.end()) return std::nullopt;
  return std::make_optional<AccessorReader>(context.document, static_cast<std::size_t>(found->second));
}

std::vector<glm::vec3> asVec3(const std::vector<float>& values) {
  std::vector<glm::vec3> vectors(values.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  }
  return vectors;
}

std::vector<glm::vec3> loadPositions(const LoadContext& context, const tinygltf::Primitive& primitive,
                                     const std::string& path) {
  std::vector<glm::vec3> positions = asVec3(attributeReader(context, primitive, "POSITION")->floats());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (isFinite(positions[i])) continue;
    throw InputError(context.where(path + "/attributes/POSITION"),
                     fmt::format("vertex {} is at ({}, {}, {}), expected finite numbers", i, positions[i].x,
                                 positions[i].y, positions[i].z));
  }
  return positions;
}

std::vector<glm::vec2> loadTexCoords(const LoadContext& context, const tinygltf::Primitive& primitive,
                                     const std::string& path, const char* name) {
  const auto reader = attributeReader(context, primitive, name);
  if (!reader) return {};
  const std::vector<float> values = reader->floats();
  std::vector<glm::vec2> coordinates(values.size() / 2);
  std::size_t odd = 0;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const glm::vec2 uv(values[2 * i], values[2 * i + 1]);
    const bool finite = std::isfinite(uv.x) && std::isfinite(uv.y);
    coordinates[i] = finite ? uv : glm::vec2(0.0f);
    if (!finite) ++odd;
  }
  if (odd > 0) {
    context.warn(path + "/attributes/" + name,
                 fmt::format("{} coordinates are not finite; they are taken as 0", odd));
  }
  return coordinates;
}

std::vector<glm::vec4> loadColors(const LoadContext& context, const tinygltf::Primitive& primitive,
                                  const std::string& path) {
  const auto reader = attributeReader(context, primitive, "COLOR_0");
  if (!reader) return {};
  constexpr int float32 = 5126;
  const std::vector<float> values = reader->floats(reader->componentType() != float32);
  const std::size_t components = reader->components();
  std::vector<glm::vec4> colors(reader->count(), glm::vec4(1.0f));
  std::size_t odd = 0;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    bool usable = true;
    for (std::size_t c = 0; c < components; ++c) {
      const float value = values[i * components + c];
      usable = usable && value >= 0.0f && value <= 1.0f;
      colors[i][static_cast<int>(c)] = std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 1.0f;
    }
    if (!usable) ++odd;
  }
  if (odd > 0)
    context.warn(path + "/attributes/COLOR_0", fmt::format("{} colours lie outside 0..1; clamped", odd));
  return colors;
}

/// Returns area-weighted mean normals in object space; +Y for vertices that no triangle of positive area
/// uses.
std::vector<glm::vec3> geometricNormals(const Primitive& primitive) {
  std::vector<glm::dvec3> sums(primitive.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& t : primitive.triangles) {
    const glm::dvec3 a = primitive.positions[t.x];
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(primitive.positions[t.y]) - a, glm::dvec3(primitive.positions[t.z]) - a);
    for (int corner = 0; corner < 3; ++corner) sums[t[corner]] += normal;
  }
  std::vector<glm::vec3> normals(sums.size(), glm::vec3(0.0f, 1.0f, 0.0f));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = glm::length(sums[i]);
    if (length > 0.0) normals[i] = glm::vec3(sums[i] / length);
  }
  return normals;
}

std::vector<glm::vec3> loadNormals(const LoadContext& context, const tinygltf::Primitive& source,
                                   const Primitive& primitive, const std::string& path) {
  const auto reader = attributeReader(context, source, "NORMAL");
  if (!reader) return {};
  std::vector<glm::vec3> normals = asVec3(reader->floats());
  std::vector<glm::vec3> geometric;
  std::size_t replaced = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const glm::dvec3 normal(normals[i]);
    const double length = glm::length(normal);
    if (std::isfinite(length) && length > 1e-12) {
      normals[i] = glm::vec3(normal / length);
      continue;
    }
    if (geometric.empty()) geometric = geometricNormals(primitive);
    normals[i] = geometric[i];
    ++replaced;
  }
  if (replaced > 0) {
    context.warn(path + "/attributes/NORMAL",
                 fmt::format("{} normals have no direction; the geometric ones stand in", replaced));
  }
  return normals;
}

/// Returns tangents as unit vectors and a sign; none at all if one has no direction.
std::vector<glm::vec4> loadTangents(const LoadContext& context, const tinygltf::Primitive& source,
                                    const std::string& path) {
  const auto reader = attributeReader(context, source, "TANGENT");
  if (!reader) return {};
  const std::vector<float> values = reader->floats();
  std::vector<glm::vec4> tangents;
  for (std::size_t i = 0; i + 3 < values.size(); i += 4) {
    const glm::dvec3 tangent(values[i], values[i + 1], values[i + 2]);
    const double length = glm::length(tangent);
    if (!std::isfinite(length) || length < 1e-12) {
      context.warn(path + "/attributes/TANGENT",
                   fmt::format("tangent {} has no direction; those of the texture coordinates stand in",
                               tangents.size()));
      return {};
    }
    tangents.emplace_back(glm::vec3(tangent / length), values[i + 3] < 0.0f ? -1.0f : 1.0f);
  }
  return tangents;
}

std::vector<std::uint32_t> loadIndices(const LoadContext& context, const tinygltf::Primitive& primitive,
                                       std::size_t vertices, const std::string& path) {
  if (primitive.indices < 0) {
    std::vector<std::uint32_t> indices(vertices);
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
  }
  const AccessorReader reader(context.document, static_cast<std::size_t>(primitive.indices));
  std::vector<std::uint32_t> indices = reader.unsignedIntegers();
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < vertices) continue;
    throw InputError(
        context.where(path + "/indices"),
        fmt::format("index {} refers to vertex {}, expected 0..{}", i, indices[i], vertices - 1));
  }
  return indices;
}

/// Returns the triangles of a list, strip or fan, with the winding and first vertex that section 3.7.2.1 of
/// the glTF 2.0 specification prescribes.
std::vector<glm::uvec3> assembleTriangles(const std::vector<std::uint32_t>& v, int mode) {
  std::vector<glm::uvec3> triangles;
  if (v.size() < 3) return triangles;
  if (mode == Triangles) {
    triangles.reserve(v.size() / 3);
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) triangles.emplace_back(v[i], v[i + 1], v[i + 2]);
    return triangles;
  }
  triangles.reserve(v.size() - 2);
  for (std::size_t i = 0; i + 2 < v.size(); ++i) {
    if (mode == TriangleStrip) {
      triangles.emplace_back(v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]);
    } else {
      triangles.emplace_back(v[i + 1], v[i + 2], v[0]);
    }
  }
  return triangles;
}

Primitive loadPrimitive(const LoadContext& context, const tinygltf::Primitive& source, const JsonCursor& json,
                        const std::string& path) {
  Primitive primitive;
  primitive.material = source.material;
  if (!source.attributes.contains("POSITION")) {
    context.warn(path, "no POSITION attribute; the primitive is skipped");
    return primitive;
  }
  const int mode = source.mode < 0 ? static_cast<int>(Triangles) : source.mode;
  if (mode < Triangles) return primitive;
  primitive.positions = loadPositions(context, source, path);
  const std::vector<std::uint32_t> indices = loadIndices(context, source, primitive.positions.size(), path);
  if (indices.size() < 3 || (mode == Triangles && indices.size() % 3 != 0)) {
    context.warn(path, fmt::format("{} indices make no whole number of triangles; the rest is dropped",
                                   indices.size()));
  }
  primitive.triangles = assembleTriangles(indices, mode);
  primitive.normals = loadNormals(context, source, primitive, path);
  primitive.tangents = loadTangents(context, source, path);
  primitive.texCoords0 = loadTexCoords(context, source, path, "TEXCOORD_0");
  primitive.texCoords1 = loadTexCoords(context, source, path, "TEXCOORD_1");
  primitive.colors = loadColors(context, source, path);
  loadMorphTargets(context, json, primitive);
  loadInfluences(context, json, path, primitive);
  return primitive;
}

}  // namespace

Mesh loadMesh(const LoadContext& context, std::size_t mesh, int variant) {
  const tinygltf::Mesh& source = context.model.meshes[mesh];
  const JsonCursor meshJson = context.root.at("meshes").at(mesh);
  Mesh result;
  result.name = source.name;
  for (std::size_t i = 0; i < source.primitives.size(); ++i) {
    const std::string path = fmt::format("/meshes/{}/primitives/{}", mesh, i);
    const JsonCursor json = meshJson.at("primitives").at(i);
    if (lacksData(context.document, json)) {
      context.warn(path, "its data lie in a buffer that the file leaves out; the primitive is skipped");
      result.primitives.emplace_back().material = source.primitives[i].material;
      continue;
    }
    Primitive& primitive =
        result.primitives.emplace_back(loadPrimitive(context, source.primitives[i], json, path));
    primitive.material = materialOfVariant(context, json, variant, primitive.material);
  }
  result.weights.assign(countTargets(result), 0.0f);
  result.weights = loadWeights(meshJson, result);
  return result;
}

void warnOfPointsAndLines(const LoadContext& context, const std::vector<bool>& meshes) {
  std::string first;
  std::size_t count = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const auto& primitives = context.model.meshes[m].primitives;
    for (std::size_t p = 0; meshes[m] && p < primitives.size(); ++p) {
      if (primitives[p].mode < 0 || primitives[p].mode >= Triangles) continue;
      if (count++ == 0) first = fmt::format("/meshes/{}/primitives/{}/mode", m, p);
    }
  }
  if (count == 1) context.warn(first, "points and lines carry no surface; the primitive is skipped");
  if (count > 1)
    context.warn(
        first,
        fmt::format("points and lines carry no surface; this primitive and {} more are skipped", count - 1));
}

}  // namespace prelight
