#include "techniques/light_map/light_map_parts.h"

#include "basis/incident_values.h"

namespace prelight {

namespace {

void addIrradiance(std::span<const glm::vec3> irradiance, std::span<float> values) {
  for (std::size_t i = 0; i < irradiance.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) values[3 * i + c] += irradiance[i][static_cast<int>(c)];
}

/// Both [texel][channel][value].
void addIncident(std::span<const float> incident, std::span<float> values) {
  for (std::size_t i = 0; i < incident.size(); ++i) values[i] += incident[i];
}

}  // namespace

void IndirectLightPart::add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
                            std::span<std::uint8_t>) {
  if (coefficients == 1)
    addIrradiance(light_.gather(texels, progress_), values);
  else
    addIncident(light_.gatherIncident(texels, progress_, incidentOrderOf(coefficients)), values);
}

void PhotonLightPart::add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
                          std::span<std::uint8_t>) {
  const std::vector<device::DensityQuery> queries =
      densityQueries(compiled_, texels, radius_, patches_.at(texels));
  if (coefficients == 1)
    addIrradiance(estimator_.estimate(queries), values);
  else
    addIncident(estimator_.estimateIncident(queries, incidentOrderOf(coefficients)), values);
}

}  // namespace prelight
