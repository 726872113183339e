#include "techniques/encoded_light/encoded_light_projector.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "base/kept_work.h"
#include "base/pace.h"
#include "base/parallel.h"
#include "basis/incident_values.h"
#include "charts/light_map_bake.h"
#include "charts/vertex_irradiance.h"
#include "techniques/encoded_light/encoding_names.h"
#include "techniques/light_map/light_map_plan.h"
#include "receivers/texel_receiver.h"
#include "transfer/surface_frame.h"

namespace prelight {

namespace {

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

}  // namespace

std::unique_ptr<Projector> encodedLightProjector(const BakeContext& context) {
  if (!context.plan.runs(Pass::EncodedLight) || context.source == nullptr) return nullptr;
  return std::make_unique<EncodedLightProjector>(context);
}

}  // namespace prelight
