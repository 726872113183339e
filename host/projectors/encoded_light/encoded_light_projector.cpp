#include "projectors/encoded_light/encoded_light_projector.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "base/parallel.h"
#include "basis/incident_values.h"
#include "charts/light_map_bake.h"
#include "charts/vertex_irradiance.h"
#include "projectors/encoded_light/encoding_names.h"
#include "projectors/light_map/light_map_plan.h"
#include "receivers/texel_receiver.h"
#include "transfer/surface_frame.h"

namespace prelight {

namespace {

constexpr std::size_t blockSize = 4096;  // places between two looks at whether to stop
constexpr auto mapCoefficients = static_cast<std::size_t>(incidentValueCount(incidentOrder));
using Incident = std::array<float, 3 * incidentTerms>;  // [channel][term]

/// Encodes `count` places, `encodeOne(i)`, on all cores.
template <typename EncodeOne>
void encodeAll(std::size_t count, const Progress& progress, const EncodeOne& encodeOne) {
  for (std::size_t first = 0; first < count; first += blockSize) {
    progress.check();
    parallelRanges(std::min(blockSize, count - first), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) encodeOne(first + i);
    });
  }
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
  encodeAll(map.layout.texels.size(), progress, [&](std::size_t i) {
    const LightMapTexel& place = map.layout.texels[i];
    const device::Receiver receiver = receiverAt(scene, place);
    const glm::mat3 frame = surfaceFrame({receiver.normal[0], receiver.normal[1], receiver.normal[2]});
    encoding.encode(incidentOf(map, place.texel), frame,
                    std::span(light.values).subspan(place.texel * encoding.values, encoding.values));
  });
  return light;
}

/// `incident`: [vertex][channel][term].
EncodedLight ofVertices(const CompiledScene& scene, std::span<const float> incident, const Encoding& encoding,
                        const Progress& progress) {
  EncodedLight light{std::string(encoding.name), std::vector<float>(scene.vertexCount() * encoding.values)};
  encodeAll(scene.vertexCount(), progress, [&](std::size_t vertex) {
    encoding.encode(incident.subspan(3 * incidentTerms * vertex, 3 * incidentTerms),
                    surfaceFrame(scene.normals[vertex]),
                    std::span(light.values).subspan(vertex * encoding.values, encoding.values));
  });
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
    const std::vector<float> incident = incidentOfVertices(context_.scene, context_.mesh, map);
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
