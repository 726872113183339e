#include "techniques/encoded_light/encoded_light_planning.h"

#include <fmt/format.h>

#include "techniques/encoded_light/encoding_names.h"
#include "techniques/light_map/light_map_plan.h"

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

}  // namespace

Planning encodedLightPlanning() {
  return {.staticLight = true,
          .passes = encodedLightPasses,
          .addMemory = addEncodedLightMemory,
          .addToKey = addEncodedLightToKey};
}

}  // namespace prelight
