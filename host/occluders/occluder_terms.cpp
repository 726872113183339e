#include "occluders/occluder_terms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "occluders/wave_table.h"

namespace prelight {

namespace {

using std::numbers::pi;

constexpr double mostConcentration = 100.0;
constexpr double leastConcentration = 0.01;
constexpr double mostCausticExponent = 0.5;
constexpr double mostThesisMagnification = 32.0;
constexpr double horizonSlack = 0.1;
constexpr double leastAlpha = 0.002;
constexpr double leastShareAlpha = 0.02;

/// Returns a cosine power whose integral over all directions is 1.
double cosineLobe(double exponent, double cosine) {
  return (exponent + 1.0) / (2.0 * pi) * std::pow(std::clamp(cosine, 0.0, 1.0), exponent);
}

glm::dvec3 clearColor(const OccluderRow& row, const OccluderRecord& record) {
  if (row.hasTransmissive) return glm::clamp(glm::dvec3(record.transmissive), 0.0, 1.0);
  if (!row.hasCaustic) return glm::dvec3(0.0);
  return glm::dvec3(std::min(record.caustic.w / std::max(record.occlusion.w, 1e-9), 1.0));
}

double acuteSine2(const glm::dvec3& a, const glm::dvec3& b) {
  if (glm::dot(a, b) <= 0.0) return 1.0;
  const glm::dvec3 across = glm::cross(a, b);
  return std::min(glm::dot(across, across), 1.0);
}

glm::dvec3 schlick(const glm::dvec3& f0, double cosine) {
  return f0 + (1.0 - f0) * std::pow(std::clamp(1.0 - cosine, 0.0, 1.0), 5.0);
}

double alphaOf(const OccluderReceiver& receiver) {
  return std::max(receiver.roughness * receiver.roughness, leastAlpha);
}

double mirrorExponent(const OccluderRecord& record, const OccluderShading& shading) {
  const double spread = 1.0 - meanOf(record.occlusion).resultant;
  const double bent = 1.0 - meanOf(record.mirrorNormal).resultant;
  return 1.0 / (1.0 / std::max(shading.specularExponent, 1.0) + spread + 4.0 * bent);
}

glm::dvec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 1e-15 ? v / length : glm::dvec3(0.0);
}

// Walter et al. 2007, Eq. 33, and Heitz 2014's masking and shadowing.
double microfacets(const OccluderReceiver& receiver, const glm::dvec3& toLight, double alpha) {
  const glm::dvec3 half = unit(receiver.toEye + toLight);
  const double nl = std::max(glm::dot(receiver.normal, toLight), 0.0);
  const double nv = std::max(glm::dot(receiver.normal, receiver.toEye), 1e-4);
  const double nh = std::clamp(glm::dot(receiver.normal, half), 0.0, 1.0);
  const double a2 = alpha * alpha;
  const glm::dvec3 across = glm::cross(receiver.normal, half);
  const double d = nh * nh * a2 + glm::dot(across, across);
  const double masking =
      nl * std::sqrt(a2 + (1.0 - a2) * nv * nv) + nv * std::sqrt(a2 + (1.0 - a2) * nl * nl);
  return a2 / (pi * std::max(d * d, 1e-12)) / (2.0 * std::max(masking, 1e-6));
}

/// Returns the light that a mirror sends by Sherif 2013, listing A.2. The listing's lights are irradiance
/// over pi here, and its weight of a mirror is the length of the sum of normals.
glm::dvec3 thesisSent(const OccluderRecord& record, const IncidentLight& there) {
  return glm::clamp(glm::dvec3(record.mirrorColor), 0.0, 1.0) * there.irradiance / pi;
}

double thesisWeight(const OccluderRecord& record) {
  return std::min(glm::length(glm::dvec3(record.mirrorNormal)), 1.0);
}

glm::dvec3 thesisMirroredLight(const OccluderReceiver& receiver, const OccluderRecord& record,
                               const IncidentLight& there, const OccluderShading& shading) {
  const glm::dvec3 toMirror = unit(glm::dvec3(record.position) - receiver.position);
  const glm::dvec3 beyond = glm::reflect(toMirror, unit(glm::dvec3(record.mirrorNormal)));
  const double aligned = thesisWeight(record) * std::clamp(glm::dot(beyond, there.toLight), 0.0, 1.0);
  return shading.diffuseFromSpecular * std::pow(aligned, std::max(shading.specularExponent, 1.0)) *
         thesisSent(record, there);
}

glm::dvec3 thesisMirroredAgain(const OccluderReceiver& receiver, const OccluderRecord& record,
                               const IncidentLight& there, const OccluderShading& shading) {
  const double weight = thesisWeight(record);
  if (!(weight > 0.0)) return glm::dvec3(0.0);
  const glm::dvec3 toMirror = unit(glm::dvec3(record.position) - receiver.position);
  const glm::dvec3 look = glm::reflect(-receiver.toEye, receiver.normal);
  const glm::dvec3 beyond = glm::reflect(look, unit(glm::dvec3(record.mirrorNormal)));
  const double looksThere = std::pow(std::clamp(glm::dot(toMirror, look), 0.0, 1.0), 1.0 - weight);
  const double again = looksThere * std::clamp(glm::dot(beyond, there.toLight), 0.0, 1.0);
  return shading.specularFromSpecular * std::pow(again, std::max(shading.specularExponent, 1.0)) *
         receiver.f0 * thesisSent(record, there);
}

/// Returns the displacement of the wave train at a receiver
/// (host/techniques/vector_occluders/occluder_wave_funcs.cl).
glm::dvec3 displacementAt(const OccluderReceiver& receiver, const OccluderEffects& effects) {
  static const std::vector<glm::vec4> table = makeWaveTable();
  const glm::dvec3 place = (receiver.position - receiver.origin) / effects.length;
  const glm::dvec3 firstAxis(0.8, 0.2, std::sqrt(0.32)), secondAxis(-0.5, 0.3, std::sqrt(0.66));
  return glm::dvec3(waveAt(table, glm::dot(place, firstAxis) + effects.moment,
                           glm::dot(place, secondAxis) + 2.0 * effects.moment));
}

glm::dvec3 bentBy(const glm::dvec3& direction, const glm::dvec3& displacement, double amplitude) {
  const glm::dvec3 across = displacement - glm::dot(displacement, direction) * direction;
  return glm::normalize(direction + amplitude * across);
}

}  // namespace

glm::dvec3 shadowOpacity(const OccluderRow& row, const OccluderRecord& record,
                         const OccluderShading& shading) {
  const double straight = row.hasCaustic ? std::max(1.0 - shading.causticStrength, 0.0) : 1.0;
  return 1.0 - straight * clearColor(row, record);
}

// Approximates the concentration for a mean resultant length by Banerjee et al., "Clustering on the unit
// hypersphere using von Mises-Fisher distributions", 2005, Eq. 4.4.
double causticDensity(const OccluderRecord& record, const glm::dvec3& toLight) {
  const MeanDirection mean = meanOf(record.caustic);
  const double r2 = mean.resultant * mean.resultant;
  const double kappa = std::clamp(mean.resultant * (3.0 - r2) / std::max(1.0 - r2, 1e-4), leastConcentration,
                                  mostConcentration);
  return kappa / (-2.0 * pi * std::expm1(-2.0 * kappa)) *
         std::exp(-kappa * (1.0 - glm::dot(mean.direction, toLight)));
}

glm::dvec3 causticLight(const OccluderRow& row, const OccluderRecord& record, const IncidentLight& there,
                        const OccluderShading& shading) {
  if (!row.hasCaustic || shading.formula == OccluderFormula::Thesis) return glm::dvec3(0.0);
  return shading.causticStrength * record.occlusion.w * causticDensity(record, there.toLight) *
         clearColor(row, record) * there.irradiance;
}

glm::dvec3 thesisFactor(const OccluderRow& row, const OccluderRecord& record, const glm::dvec3& toLight,
                        const OccluderShading& shading) {
  const glm::dvec3 direction = meanOf(record.occlusion).direction;
  double blockage = 1.0;
  if (direction != glm::dvec3(0.0))
    blockage = std::pow(acuteSine2(direction, toLight), shading.shadowStrength * record.occlusion.w);
  const glm::dvec3 color = clearColor(row, record);
  double magnified = 1.0;
  const double share = record.caustic.w;
  const double exponent = std::min(shading.causticStrength * share, mostCausticExponent);
  const glm::dvec3 way = meanOf(record.caustic).direction;
  if (row.hasCaustic && exponent > 0.0 && way != glm::dvec3(0.0)) {
    const double sine2 =
        std::max(acuteSine2(way, toLight), 1.0 / (mostThesisMagnification * mostThesisMagnification));
    const double mean = exponent / (1.0 - exponent);
    magnified += std::min(1.0, share / mean) * (std::pow(sine2, -exponent) - 1.0);
  }
  return blockage * (1.0 - color) + magnified * color;
}

glm::dvec3 mirroredLight(const OccluderReceiver& receiver, const OccluderRecord& record,
                         const IncidentLight& there, const OccluderShading& shading) {
  if (shading.mirrors == MirrorFormula::Thesis) return thesisMirroredLight(receiver, record, there, shading);
  const glm::dvec3 normal = meanOf(record.mirrorNormal).direction;
  const glm::dvec3 way = unit(glm::dvec3(record.position) - receiver.position);
  const double cosine = glm::dot(glm::reflect(way, normal), there.toLight);
  return shading.diffuseFromSpecular * record.mirrorNormal.w *
         cosineLobe(mirrorExponent(record, shading), cosine) *
         glm::clamp(glm::dvec3(record.mirrorColor), 0.0, 1.0) * there.irradiance;
}

glm::dvec3 mirroredAgain(const OccluderReceiver& receiver, const OccluderRecord& record,
                         const IncidentLight& there, const OccluderShading& shading) {
  if (shading.mirrors == MirrorFormula::Thesis) return thesisMirroredAgain(receiver, record, there, shading);
  const glm::dvec3 normal = meanOf(record.mirrorNormal).direction;
  const MeanDirection toOccluder = meanOf(record.occlusion);
  const glm::dvec3 look = glm::reflect(-receiver.toEye, receiver.normal);
  const double solidAngle = pi * record.mirrorNormal.w /
                            (std::max(glm::dot(receiver.normal, toOccluder.direction), 0.0) + horizonSlack);
  const double alpha = alphaOf(receiver);
  const double exponent = 1.0 / (0.5 * alpha * alpha + (1.0 - toOccluder.resultant) + 1e-3);
  const double share = std::min(1.0, solidAngle * cosineLobe(exponent, glm::dot(look, toOccluder.direction)));
  const double aligned =
      cosineLobe(mirrorExponent(record, shading), glm::dot(glm::reflect(look, normal), there.toLight));
  return shading.specularFromSpecular * share * aligned *
         schlick(receiver.f0, std::max(glm::dot(receiver.normal, receiver.toEye), 0.0)) *
         glm::clamp(glm::dvec3(record.mirrorColor), 0.0, 1.0) * there.irradiance;
}

// Uses Fujii, "A tiny improvement of Oren-Nayar reflectance model", 2012.
double roughDiffuse(const OccluderReceiver& receiver, const glm::dvec3& toLight) {
  const double nl = glm::dot(receiver.normal, toLight);
  const double nv = std::max(glm::dot(receiver.normal, receiver.toEye), 0.0);
  const double s = glm::dot(toLight, receiver.toEye) - nl * nv;
  const double t = s > 0.0 ? std::max({nl, nv, 1e-4}) : 1.0;
  const double sigma = receiver.roughness;
  const double a = 1.0 / (pi + (pi / 2.0 - 2.0 / 3.0) * sigma);
  return std::max(pi * a * (1.0 + sigma * s / t), 0.0);
}

glm::dvec3 glossyBrdf(const OccluderReceiver& receiver, const glm::dvec3& toLight) {
  const glm::dvec3 half = unit(receiver.toEye + toLight);
  return microfacets(receiver, toLight, alphaOf(receiver)) *
         schlick(receiver.f0, std::max(glm::dot(receiver.toEye, half), 0.0));
}

double highlightWeight(const OccluderReceiver& receiver, const glm::dvec3& toLight) {
  return microfacets(receiver, toLight, std::max(alphaOf(receiver), leastShareAlpha));
}

OccluderRecord bentRecord(const OccluderReceiver& receiver, const OccluderRecord& record,
                          const OccluderEffects& effects) {
  if (!(effects.waves > 0.0)) return record;
  const glm::dvec3 displacement = displacementAt(receiver, effects);
  const auto bend = [&](const glm::dvec4& sum) {
    const double length = glm::length(glm::dvec3(sum));
    if (!(length > 1e-15)) return sum;
    return glm::dvec4(length * bentBy(glm::dvec3(sum) / length, displacement, effects.waves), sum.w);
  };
  OccluderRecord bent = record;
  bent.occlusion = bend(record.occlusion);
  bent.caustic = bend(record.caustic);
  return bent;
}

OccluderReceiver bentReceiver(const OccluderReceiver& receiver, const OccluderEffects& effects) {
  if (!(effects.normalWaves > 0.0) || glm::dot(receiver.normal, receiver.normal) < 0.5) return receiver;
  OccluderReceiver bent = receiver;
  bent.normal = bentBy(receiver.normal, displacementAt(receiver, effects), effects.normalWaves);
  return bent;
}

glm::dvec3 flickerOf(std::size_t light, const OccluderEffects& effects) {
  if (!(effects.fire > 0.0)) return glm::dvec3(1.0);
  static const std::vector<glm::vec4> table = makeWaveTable();
  // Fractions of the golden ratio keep the lights' phases apart.
  const double number = static_cast<double>(light % 64), golden = 0.5 * (std::sqrt(5.0) - 1.0);
  const double wave =
      waveAt(table, golden * number + 3.0 * effects.moment, golden * golden * number + 5.0 * effects.moment)
          .w;
  const double strength = std::max(1.0 + effects.fire * wave, 0.0), low = std::min(strength, 1.0);
  return strength * glm::dvec3(1.0, 0.6 + 0.4 * low, 0.2 + 0.8 * low);
}

}  // namespace prelight
