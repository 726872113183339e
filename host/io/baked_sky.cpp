#include "io/baked_sky.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>

#include "base/state_file.h"
#include "io/values/value_reader.h"

namespace prelight {
namespace {

constexpr int hashBase = 16;

std::uint64_t hashFromJson(const JsonCursor& json) {
  const std::string text = json.asString();
  std::uint64_t hash = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, hashBase);
  if (error != std::errc{} || end != text.data() + text.size())
    json.fail(fmt::format("expected 64 bits in hexadecimal digits, got \"{}\"", text));
  return hash;
}

}  // namespace

std::uint64_t skyHash(const Environment& sky) {
  return StateHash().value(sky.width).value(sky.height).values(sky.radiance).result();
}

nlohmann::ordered_json toJson(const BakedSky& sky) {
  return {{"name", sky.name}, {"rotation", sky.rotation}, {"hash", fmt::format("{:016x}", sky.hash)}};
}

BakedSky bakedSkyFromJson(const JsonCursor& json) {
  BakedSky sky;
  sky.name = json.stringOr("name", "");
  sky.rotation = json.numberOr("rotation", 0.0);
  if (!std::isfinite(sky.rotation)) json.at("rotation").fail("expected radians");
  sky.hash = hashFromJson(json.at("hash"));
  return sky;
}

std::optional<BakedSky> readBakedSky(const GltfDocument& document) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  const auto extension = transferExtension(root);
  if (!extension) return std::nullopt;
  const auto sky = extension->find("sky");
  if (!sky) return std::nullopt;
  return bakedSkyFromJson(*sky);
}

}  // namespace prelight
