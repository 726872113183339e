#include "techniques/encoded_light/encoded_light_technique.h"

#include <fmt/format.h>

#include <algorithm>

#include "encodings/registry/registry.h"
#include "io/values/append_values.h"
#include "io/values/vertex_values.h"
#include "techniques/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

constexpr const char* member = "encodedLight";

std::size_t encodedLightBytes(const Bake& bake) {
  std::size_t bytes = 0;
  for (const EncodedLight& light : bake.encodedLight) bytes += bytesOf(light.values);
  return bytes;
}

void writeEncodedLightEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  for (const EncodedLight& light : output.bake.encodedLight) {
    const std::size_t width = light.values.size() / std::max(1u, output.scene.vertexCount());
    entry[member].push_back({{"encoding", light.encoding},
                             {"values", appendVertices(output.document, light.values, ranges, width)}});
  }
}

class EncodedLightReader final : public TechniqueReader {
 public:
  explicit EncodedLightReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find(member);
    if (!json) return;
    std::vector<EncodedLight> found;
    for (std::size_t i = 0; i < json->arraySize(); ++i) readOne(json->at(i), ranges, found);
    if (bake.encodedLight.empty())
      for (const EncodedLight& light : found) bake.encodedLight.push_back({light.encoding, {}});
    expectSame(
        *json,
        std::ranges::equal(found, bake.encodedLight, {}, &EncodedLight::encoding, &EncodedLight::encoding),
        "encodings");
    for (std::size_t i = 0; i < found.size(); ++i)
      placeVertices(found[i].values, ranges, encodingNamed(found[i].encoding)->values, input_.scene,
                    bake.encodedLight[i].values);
  }

 private:
  /// Encodings that are not known are left out, as members are.
  void readOne(const JsonCursor& json, const PrimitiveRanges& ranges,
               std::vector<EncodedLight>& found) const {
    const std::string name = json.at("encoding").asString();
    const Encoding* encoding = encodingNamed(name);
    if (encoding == nullptr) return;
    if (std::ranges::count(found, name, &EncodedLight::encoding) > 0)
      json.fail(fmt::format("the encoding {} for a second time, expected each once", name), rebake);
    found.push_back(
        {name, values_.floats(json.at("values"), "SCALAR", vertexCount(ranges) * encoding->values)});
  }

  const BakedInput& input_;
  ValueReader values_;
};

void summarizeEncodedLight(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  for (const EncodedLight& light : bake.encodedLight) {
    const Encoding* encoding = encodingNamed(light.encoding);
    found.push_back({fmt::format("{}.{}", member, light.encoding),
                     fmt::format("incident light as {}, {} numbers", light.encoding, encoding->values),
                     bytesOf(light.values),
                     true,
                     {{"values", encoding->values}, {"summary", encoding->summary}}});
  }
  if (!bake.lightMap) return;
  for (const EncodedLight& light : bake.lightMap->encoded) {
    const Encoding* encoding = encodingNamed(light.encoding);
    const std::size_t bytes = encoding->values * sizeof(float) * bake.lightMap->layout.texels.size();
    found.push_back({fmt::format("lightMap.{}", light.encoding),
                     fmt::format("the light map's incident light as {}, {} numbers per texel", light.encoding,
                                 encoding->values),
                     bytes,
                     false,
                     {{"values", encoding->values}, {"bytes", bytes}}});
  }
}

}  // namespace

Technique encodedLightTechnique() {
  return {.name = "encoded_light",
          .members = {member},
          .use = {.scattering = true, .lights = true},
          .accessors = {"values"},
          .storedBytes = encodedLightBytes,
          .writeEntry = writeEncodedLightEntry,
          .makeReader = makeTechniqueReader<EncodedLightReader>,
          .summarize = summarizeEncodedLight};
}

}  // namespace prelight
