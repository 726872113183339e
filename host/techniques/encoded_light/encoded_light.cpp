#include "techniques/encoded_light/encoded_light.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "base/clocks.h"
#include "base/kept_work.h"
#include "base/parallel.h"
#include "basis/incident_values.h"
#include "charts/light_map_bake.h"
#include "charts/vertex_irradiance.h"
#include "encodings/registry/registry.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "options/rows.h"
#include "receivers/surface_sampler.h"
#include "scene/surface/surface_frame.h"
#include "techniques/encoded_light/encoding_names.h"
#include "techniques/light_map/light_map_plan.h"
#include "techniques/projector.h"

namespace prelight {

namespace {

std::string storedText(const EncodedLightRequest& request) {
  std::string text;
  for (const Encoding* encoding : encodingsNamed(request.encodings))
    text +=
        fmt::format("{}{} ({} numbers a place)", text.empty() ? "" : ", ", encoding->name, encoding->values);
  return text;
}

std::vector<PlannedPass> encodedLightPasses(const PlanInput& input) {
  constexpr Pass name = Pass::EncodedLight;
  const EncodedLightRequest& request = input.request.encodedLight;
  if (!request) return {};
  if (!input.request.lightMap)
    return {{name, false, "they encode the light of a light map, which is not asked for"}};
  if (!takesLight(input.scene)) return {{name, false, "no surface reflects diffusely, so none needs light"}};
  return {{name, true,
           fmt::format("incident radiance in SH of order {} at texels and vertices, stored as {}",
                       incidentOrder, storedText(request))}};
}

/// Besides the light map's own, whose texels hold what is encoded until it is.
void addEncodedLightMemory(const PlanInput& input, Plan& plan) {
  if (!plan.runs(Pass::EncodedLight)) return;
  constexpr std::uint64_t bytesPerNumber = 2 * sizeof(float);  // as it is, and while it is written
  constexpr std::uint64_t bytesPerFitted = 3 * 8;              // of the normal equations' right sides
  std::uint64_t numbers = 0;
  for (const Encoding* encoding : encodingsNamed(input.request.encodedLight.encodings))
    numbers += encoding->values;
  const std::uint64_t vertices = input.scene.vertexCount();
  plan.hostBytes += bytesPerNumber * numbers * (mostTexels(input.scene, input.request) + vertices) +
                    bytesPerFitted * 3 * incidentTerms * vertices;
}

void addEncodedLightToKey(const BakeRequest& request, StateHash& hash) {
  for (const std::string& name : request.encodedLight.encodings) hash.text(name);
}

constexpr std::size_t encodingGrain = 64;  // places that a thread takes at once
constexpr std::size_t leastEncoded = 16 * encodingGrain,
                      mostEncoded = 1024 * encodingGrain;  // between two looks at whether to stop
constexpr auto mapCoefficients = static_cast<std::size_t>(incidentValueCount(incidentOrder));
using Incident = std::array<float, 3 * incidentTerms>;  // [channel][term]

template <typename Row>
void exchangeRows(StateWriter& state, std::uint64_t done, std::size_t width, const Row& row) {
  std::vector<float> rows;
  state.growing(0, done, width * sizeof(float), [&](std::uint64_t first, std::uint64_t count) {
    rows.clear();
    for (std::uint64_t i = first; i < first + count; ++i)
      rows.insert(rows.end(), row(i).begin(), row(i).end());
    return std::as_bytes(std::span(rows));
  });
}

template <typename Row>
void exchangeRows(StateReader& state, std::uint64_t done, std::size_t width, const Row& row) {
  state.growing(done, width * sizeof(float), [&](std::uint64_t first, std::span<const std::byte> bytes) {
    for (; !bytes.empty(); bytes = bytes.subspan(width * sizeof(float)), ++first) {
      std::memcpy(row(first).data(), bytes.data(), width * sizeof(float));
      state.requireFinite(row(first));
    }
  });
}

/// Encodes the rows of `values`, one a place, on all cores: `encodeOne(place, row)`. rowOf(place) is the
/// number of its row. Rows are kept.
template <typename RowOf, typename EncodeOne>
void encodeAll(std::size_t count, std::size_t width, const Progress& progress, std::vector<float>& values,
               const RowOf& rowOf, const EncodeOne& encodeOne) {
  const auto row = [&](std::size_t place) { return std::span(values).subspan(rowOf(place) * width, width); };
  std::uint64_t done = 0;
  WorkPart part(progress, "encoding", [&](auto& state) {
    state.value(done);
    state.require(done <= count);
    exchangeRows(state, done, width, row);
  });
  Pace pace(leastEncoded, mostEncoded);
  while (done < count) {
    progress.check();
    const std::size_t some = pace.next(count - done);
    parallelRanges(some, encodingGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = done + begin; i < done + end; ++i) encodeOne(i, row(i));
    });
    done += some;
    part.advance();
  }
  part.finish();
}

Incident incidentOf(const LightMap& map, std::uint32_t texel) {
  Incident incident;
  for (std::size_t channel = 0; channel < 3; ++channel)
    std::copy_n(&map.values[(3 * std::size_t{texel} + channel) * mapCoefficients + 1], incidentTerms,
                &incident[channel * incidentTerms]);
  return incident;
}

EncodedLight ofTexels(const CompiledScene& scene, const LightMap& map, const Encoding& encoding,
                      const Progress& progress) {
  EncodedLight light{std::string(encoding.name),
                     std::vector<float>(map.layout.texelCount() * encoding.values)};
  const std::vector<LightMapTexel>& places = map.layout.texels;
  const auto rowOf = [&](std::size_t i) { return places[i].texel; };
  encodeAll(
      places.size(), encoding.values, progress, light.values, rowOf,
      [&](std::size_t i, std::span<float> row) {
        const LightMapTexel& place = places[i];
        const device::Receiver receiver = receiverAt(scene, place);
        const glm::mat3 frame = surfaceFrame({receiver.normal[0], receiver.normal[1], receiver.normal[2]});
        encoding.encode(incidentOf(map, place.texel), frame, row);
      });
  return light;
}

/// `incident`: [vertex][channel][term].
EncodedLight ofVertices(const CompiledScene& scene, std::span<const float> incident, const Encoding& encoding,
                        const Progress& progress) {
  EncodedLight light{std::string(encoding.name), std::vector<float>(scene.vertexCount() * encoding.values)};
  const auto rowOf = [](std::size_t vertex) { return vertex; };
  const auto encodeOne = [&](std::size_t vertex, std::span<float> row) {
    encoding.encode(incident.subspan(3 * incidentTerms * vertex, 3 * incidentTerms),
                    surfaceFrame(scene.normals[vertex]), row);
  };
  encodeAll(scene.vertexCount(), encoding.values, progress, light.values, rowOf, encodeOne);
  return light;
}

/// Comes after the light map, whose light it encodes.
class EncodedLightProjector final : public Projector {
 public:
  explicit EncodedLightProjector(const BakeContext& context) : context_(context) {}

  std::string_view stage() const override { return "encoded light"; }

  void run(ReceiverCast* /*cast*/, Bake& bake, Progress& progress) override {
    LightMap& map = *bake.lightMap;
    assert(static_cast<std::size_t>(map.coefficients) == mapCoefficients);
    const std::vector<float> incident = incidentOfVertices(context_.scene, context_.mesh, map, progress);
    for (const Encoding* encoding : encodingsNamed(context_.request.encodedLight.encodings)) {
      map.encoded.push_back(ofTexels(context_.scene, map, *encoding, progress));
      bake.encodedLight.push_back(ofVertices(context_.scene, incident, *encoding, progress));
    }
    keepCoefficients(map, keptLightMapCoefficients(context_.plan));
  }

 private:
  const BakeContext& context_;
};

std::unique_ptr<Projector> makeEncodedLightProjector(const BakeContext& context) {
  if (!context.plan.runs(Pass::EncodedLight) || context.source == nullptr) return nullptr;
  return std::make_unique<EncodedLightProjector>(context);
}

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

void addEncodedLightArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
  for (const EncodedLight& light : bake.encodedLight)
    arrays.push_back({"vertices." + light.encoding, "[vertex][value]", {light.values}});
  if (!bake.lightMap) return;
  const LightMapLayout& layout = bake.lightMap->layout;
  for (const EncodedLight& light : bake.lightMap->encoded)
    arrays.push_back({"lightMap." + light.encoding,
                      fmt::format("[row {}][column {}][value]", layout.height, layout.width),
                      {light.values}});
}

std::string encodingsText(const BakeRequest& request) {
  return fmt::format("{}", fmt::join(request.encodedLight.encodings, ","));
}

constexpr Option<BakeRequest> encode() {
  Option<BakeRequest> row = options::BakeRow::own(
      {.field = "EncodedLightRequest::encodings",
       .name = "encode",
       .help = "light map: also store how the light at texels and vertices depends on direction, for "
               "normal maps, in the encodings NAME[,NAME...]",
       .example = "ambient-cube,sh"});
  row.text = encodingsText;
  return row;
}

constexpr auto encodedLightOptions = std::to_array<Option<BakeRequest>>({
    encode(),
});

}  // namespace

Technique encodedLightTechnique() {
  return {.name = "encoded_light",
          .options = {.rows = encodedLightOptions, .behind = "denoise"},
          .part = &encodingPart,
          .use = {.scattering = true, .lights = true},
          .plan = {.staticLight = true,
                   .passes = encodedLightPasses,
                   .addMemory = addEncodedLightMemory,
                   .addToKey = addEncodedLightToKey},
          .makeProjector = makeEncodedLightProjector,
          .file = {.members = {member},
                   .accessors = {"values"},
                   .storedBytes = encodedLightBytes,
                   .writeEntry = writeEncodedLightEntry,
                   .makeReader = makeTechniqueReader<EncodedLightReader>},
          .summarize = summarizeEncodedLight,
          .addArrays = addEncodedLightArrays};
}

}  // namespace prelight
