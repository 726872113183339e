#include "occluders/occluder_upload.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "occluders/occluder_record.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr int baseVectors = 5, throughVectors = 3, mirrorVectors = 3;  // vectors of a prepared record

void set(float* to, const glm::dvec3& value) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(value[i]);
}

glm::dvec3 get(const float* from) { return {from[0], from[1], from[2]}; }

}  // namespace

OccluderUpload::OccluderUpload(const OccluderTransfer& transfer, const glm::dvec3& origin) {
  const auto has = [&](OccluderVector vector) { return placeOf(transfer, vector) < transfer.stored.size(); };
  for (const OccluderVector needed : {OccluderVector::Position, OccluderVector::Occlusion,
                                      OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor})
    if (!has(needed))
      throw UsageError("vector occluders",
                       "no " + std::string(occluderVectorNames[static_cast<std::size_t>(needed)]) +
                           " is stored, which shading needs");
  const bool caustic = has(OccluderVector::Caustic), transmissive = has(OccluderVector::Transmissive);
  const bool specular = has(OccluderVector::SpecularNormal) && has(OccluderVector::SpecularColor);
  stored = (transmissive ? PRELIGHT_STORES_TRANSMISSIVE : 0) | (caustic ? PRELIGHT_STORES_CAUSTIC : 0) |
           (specular ? PRELIGHT_STORES_SPECULAR : 0);
  stride = baseVectors + (transmissive || caustic ? throughVectors : 0) + (specular ? mirrorVectors : 0);

  records.reserve(transfer.vectors.size());
  owners.reserve(transfer.recordCount());
  for (std::size_t r = 0; r < transfer.recordCount(); ++r) {
    for (std::size_t i = 0; i < transfer.stored.size(); ++i) {
      const OccluderVector kind = transfer.stored[i];
      if (!specular && (kind == OccluderVector::SpecularNormal || kind == OccluderVector::SpecularColor))
        continue;
      glm::vec4 vector = transfer.vectors[r * transfer.stored.size() + i];
      if (kind == OccluderVector::Position)
        vector = glm::vec4(glm::vec3(glm::dvec3(vector) - origin), vector.w);
      records.push_back(vector);
    }
  }
  for (std::size_t v = 0; v + 1 < transfer.offsets.size(); ++v) {
    const std::size_t row = transfer.offsets[v + 1] - transfer.offsets[v];
    owners.insert(owners.end(), row, static_cast<std::int32_t>(v));
    longestRow = std::max(longestRow, row);
  }
}

device::OccluderTerms OccluderUpload::terms(const OccluderShading& shading, const OccluderEye& eye,
                                            std::size_t lightCount) const {
  device::OccluderTerms terms{};
  terms.stored = stored;
  terms.stride = stride;
  terms.lightCount = static_cast<int>(lightCount);
  terms.thesisFormula = shading.formula == OccluderFormula::Thesis ? 1 : 0;
  terms.thesisMirrors = shading.mirrors == MirrorFormula::Thesis ? 1 : 0;
  terms.orenNayar = shading.receiver == DiffuseReceiver::OrenNayar ? 1 : 0;
  terms.shadowStrength = static_cast<float>(shading.shadowStrength);
  terms.causticStrength = static_cast<float>(shading.causticStrength);
  terms.bleeding = static_cast<float>(shading.bleeding);
  terms.diffuseFromSpecular = static_cast<float>(shading.diffuseFromSpecular);
  terms.specularFromSpecular = static_cast<float>(shading.specularFromSpecular);
  terms.specularExponent = static_cast<float>(shading.specularExponent);
  terms.waves = static_cast<float>(shading.effects.waves);
  terms.waveNumber = static_cast<float>(1.0 / shading.effects.length);
  terms.moment = static_cast<float>(shading.effects.moment);
  terms.fire = static_cast<float>(shading.effects.fire);
  terms.eyeIsPoint = eye.isPoint ? 1.0f : 0.0f;
  terms.eyeX = static_cast<float>(eye.position.x);
  terms.eyeY = static_cast<float>(eye.position.y);
  terms.eyeZ = static_cast<float>(eye.position.z);
  terms.normalWaves = static_cast<float>(shading.effects.normalWaves);
  return terms;
}

bool samePreparation(const device::OccluderTerms& a, const device::OccluderTerms& b) {
  const bool still = a.waves == 0.0f && a.normalWaves == 0.0f;
  const bool sameWaves = a.waves == b.waves && a.normalWaves == b.normalWaves &&
                         (still || (a.waveNumber == b.waveNumber && a.moment == b.moment));
  return sameWaves && a.thesisFormula == b.thesisFormula && a.thesisMirrors == b.thesisMirrors &&
         a.causticStrength == b.causticStrength && a.specularExponent == b.specularExponent;
}

device::OccluderLight occluderPointLight(const glm::dvec3& position, const glm::dvec3& intensity,
                                         double leastDistance) {
  device::OccluderLight light{};
  set(light.position, position);
  set(light.intensity, intensity);
  light.kind = PRELIGHT_LIGHT_POINT;
  light.extent = static_cast<float>(leastDistance * leastDistance);
  light.highlight = 1.0f;
  return light;
}

device::OccluderLight occluderFarLight(const glm::dvec3& toLight, const glm::dvec3& irradiance) {
  device::OccluderLight light{};
  set(light.direction, -toLight);
  set(light.intensity, irradiance);
  light.kind = PRELIGHT_LIGHT_DIRECTIONAL;
  light.highlight = 1.0f;
  return light;
}

IncidentLight incidentFrom(const device::OccluderLight& light, const glm::dvec3& point) {
  IncidentLight incident;
  incident.highlights = light.highlight > 0.5f;
  incident.irradiance = get(light.intensity);
  if (light.kind == PRELIGHT_LIGHT_DIRECTIONAL) {
    incident.toLight = -get(light.direction);
    return incident;
  }
  const glm::dvec3 path = get(light.position) - point;
  incident.distance = glm::length(path);
  incident.toLight = incident.distance > 1e-15 ? path / incident.distance : glm::dvec3(0.0);
  const double square = incident.distance * incident.distance;
  const double cosine = -glm::dot(get(light.direction), incident.toLight);
  double falloff = 1.0 / std::max(square, double(light.extent));
  if (light.kind == PRELIGHT_LIGHT_EMITTER) {
    const double area = light.extent;
    const double lobe = light.twoSided > 0.5f ? std::abs(cosine) : std::max(cosine, 0.0);
    falloff = lobe * area / (square + area / std::numbers::pi);
  } else if (light.range > 0.0f) {
    const double ratio2 = square / (double(light.range) * light.range);
    falloff *= std::clamp(1.0 - ratio2 * ratio2, 0.0, 1.0);
  }
  if (light.kind == PRELIGHT_LIGHT_SPOT)
    falloff *= std::pow(std::clamp(cosine * light.coneScale + light.coneOffset, 0.0, 1.0), 2.0);
  incident.irradiance *= falloff;
  return incident;
}

}  // namespace prelight
