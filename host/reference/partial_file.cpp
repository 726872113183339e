#include "reference/partial_file.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <span>
#include <sstream>
#include <string>

#include "base/error.h"
#include "device/program_cache.h"
#include "io/atomic_file.h"

namespace prelight::reference {

namespace {

// The file: a line that names the format, a line of JSON (identity, passes, blockPixels, size and SHA-256 of
// the rest), then the sums, means and squares of all pixels as native doubles.
constexpr const char* formatLine = "prelight reference, unfinished, version 1";

using Json = nlohmann::ordered_json;

template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <typename T>
void take(const std::string& bytes, std::size_t& at, std::vector<T>& values) {
  std::memcpy(values.data(), bytes.data() + at, values.size() * sizeof(T));
  at += values.size() * sizeof(T);
}

std::string hashOf(const std::string& bytes) { return sha256(bytes).substr(0, 32); }

std::string materialBytes(const CompiledScene& scene, const std::vector<Image>& images) {
  std::string bytes;
  for (const CompiledMaterial& m : scene.materials) {
    const auto layer = [](const LayerTexture& t) {
      return fmt::format("{},{},{}", t.image, static_cast<int>(t.wrapS), static_cast<int>(t.wrapT));
    };
    bytes +=
        fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} ", m.baseColor.x, m.baseColor.y, m.baseColor.z,
                    m.baseColorImage, static_cast<int>(m.wrapS), static_cast<int>(m.wrapT), m.metallic,
                    m.roughness, layer(m.surfaceTexture), m.emissionFactor.x, m.emissionFactor.y,
                    m.emissionFactor.z, layer(m.emissionTexture), m.transmission);
    bytes += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", m.solid, m.ior, m.absorption.x,
                         m.absorption.y, m.absorption.z, m.specular, m.specularColor.x, m.specularColor.y,
                         m.specularColor.z, m.unlit, m.doubleSided, m.albedoImage, m.alphaCutoff,
                         m.alphaFactor, m.albedo.x);
  }
  for (const auto* list : {&images, &scene.albedoImages}) {
    for (const Image& image : *list) {
      bytes += fmt::format("{}x{}\n", image.width, image.height);
      append(bytes, image.rgba);
    }
  }
  return bytes;
}

std::string sceneHash(const ReferenceInputs& inputs) {
  const CompiledScene& s = inputs.scene;
  std::string bytes = fmt::format("{} {} {}\n", s.origin.x, s.origin.y, s.origin.z);
  append(bytes, s.positions);
  append(bytes, s.normals);
  append(bytes, s.texCoords);
  append(bytes, s.colors);
  append(bytes, s.triangles);
  append(bytes, s.triangleMaterials);
  append(bytes, s.triangleFlat);
  return hashOf(bytes + materialBytes(s, inputs.images));
}

std::string lightText(const Light& l) {
  return fmt::format("{} {} {} {} at {} {} {} to {} {} {} range {} cone {} {}", static_cast<int>(l.type),
                     l.intensity.x, l.intensity.y, l.intensity.z, l.position.x, l.position.y, l.position.z,
                     l.direction.x, l.direction.y, l.direction.z, l.range, l.innerConeAngle,
                     l.outerConeAngle);
}

std::string cameraText(const Camera& c) {
  std::string text = fmt::format("{} {} {} {} {} {}", c.perspective, c.yFov, c.zNear, c.zFar, c.xMag, c.yMag);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) text += fmt::format(" {}", c.world[column][row]);
  return text;
}

std::string effort(const ReferenceRequest& request) {
  if (request.error) return fmt::format("--error {}", *request.error);
  if (request.seconds) return fmt::format("--time {}", *request.seconds);
  return fmt::format("--spp {}", request.samples);
}

[[noreturn]] void refuseBroken(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string(), "is no state of an unfinished picture: " + what,
                   "delete it and start anew");
}

void compareIdentities(const std::filesystem::path& path, const Json& found, const Json& expected) {
  std::string differences;
  for (const auto& [name, value] : expected.items()) {
    const Json other = found.is_object() && found.contains(name) ? found[name] : Json(nullptr);
    if (other == value) continue;
    const auto text = [](const Json& json) {
      return json.is_string() ? json.get<std::string>() : json.dump();
    };
    const std::string shown = value.is_string() && value.get<std::string>().size() > 40
                                  ? ""
                                  : fmt::format(" (was {}, is {})", text(other), text(value));
    differences += (differences.empty() ? "" : ", ") + name + shown;
  }
  if (!differences.empty())
    throw InputError(path.string(), "the unfinished picture is another one, it differs in " + differences,
                     "resume it with what it was begun with, or leave --resume out to start anew");
}

}  // namespace

Json identityOf(const ReferenceInputs& inputs, const ReferenceRequest& request, const DeviceInfo& device) {
  std::string lights;
  for (const Light& light : inputs.lights) lights += lightText(light) + "\n";
  std::string sky = "none";
  if (inputs.sky != nullptr) {
    sky = fmt::format("{}x{} ", inputs.sky->width, inputs.sky->height);
    append(sky, inputs.sky->radiance);
    sky = hashOf(sky);
  }
  return {{"scene", sceneHash(inputs)},
          {"lights", hashOf(lights)},
          {"camera", hashOf(cameraText(inputs.camera))},
          {"env", sky},
          {"rotate-env", inputs.skyRotation},
          {"size", fmt::format("{}x{}", request.width, request.height)},
          {"integrator", integratorName(request.integrator)},
          {"depth", request.depth},
          {"effort", effort(request)},
          {"seed", request.seed},
          {"device", fmt::format("{} / {}", device.name, device.driverVersion)},
          {"version", PRELIGHT_VERSION}};
}

std::filesystem::path partialPath(const std::filesystem::path& output) {
  std::filesystem::path path = output;
  path += ".partial";
  return path;
}

void writePartial(const std::filesystem::path& path, const Json& identity, const Film& film) {
  std::string body;
  append(body, film.sums);
  append(body, film.means);
  append(body, film.squares);
  const Json header = {{"identity", identity},
                       {"width", film.width},
                       {"height", film.height},
                       {"passes", film.passes},
                       {"blockPixels", film.blockPixels},
                       {"bytes", body.size()},
                       {"sha256", sha256(body)}};
  const std::string head = std::string(formatLine) + "\n" + header.dump() + "\n";
  const std::span<const std::byte> pieces[] = {std::as_bytes(std::span(head)),
                                               std::as_bytes(std::span(body))};
  writeFileAtomically(path, pieces);
}

std::optional<Film> readPartial(const std::filesystem::path& path, const Json& identity) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line) || line != formatLine) refuseBroken(path, "its first line is another");
  std::getline(file, line);
  const Json header = Json::parse(line, nullptr, false);
  if (!header.is_object() || !header.contains("identity")) refuseBroken(path, "its header is broken");
  compareIdentities(path, header["identity"], identity);
  std::ostringstream rest;
  rest << file.rdbuf();
  const std::string body = rest.str();
  if (header.value("sha256", "") != sha256(body)) refuseBroken(path, "it is cut short or was changed");
  Film film(header.value("width", 0), header.value("height", 0));
  film.passes = header.value("passes", std::uint64_t{0});
  film.blockPixels = header.value("blockPixels", std::uint64_t{0});
  if (body.size() != film.pixelCount() * (sizeof(glm::dvec3) + 2 * sizeof(double)) ||
      film.blockPixels >= film.pixelCount())
    refuseBroken(path, "its size is not that of the picture");
  std::size_t at = 0;
  take(body, at, film.sums);
  take(body, at, film.means);
  take(body, at, film.squares);
  return film;
}

}  // namespace prelight::reference
