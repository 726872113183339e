#include "occluders/occluder_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace prelight {

OccluderRow occluderRow(const OccluderTransfer& transfer, std::size_t vertex) {
  const std::size_t count = transfer.stored.size();
  std::array<std::size_t, occluderVectorNames.size()> places{};
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = placeOf(transfer, static_cast<OccluderVector>(i));
  const auto has = [&](OccluderVector vector) { return places[static_cast<std::size_t>(vector)] < count; };
  const auto read = [&](std::size_t record, OccluderVector vector) {
    const std::size_t place = places[static_cast<std::size_t>(vector)];
    return place == count ? glm::dvec4(0.0) : glm::dvec4(transfer.vectors[record * count + place]);
  };
  OccluderRow row;
  row.hasCaustic = has(OccluderVector::Caustic);
  row.hasTransmissive = has(OccluderVector::Transmissive);
  row.hasSpecular = has(OccluderVector::SpecularNormal) && has(OccluderVector::SpecularColor);
  for (std::size_t r = transfer.offsets[vertex]; r < transfer.offsets[vertex + 1]; ++r) {
    row.records.push_back({read(r, OccluderVector::Position), read(r, OccluderVector::Occlusion),
                           read(r, OccluderVector::Caustic), read(r, OccluderVector::Transmissive),
                           read(r, OccluderVector::DiffuseNormal), read(r, OccluderVector::DiffuseColor),
                           read(r, OccluderVector::SpecularNormal), read(r, OccluderVector::SpecularColor)});
  }
  return row;
}

MeanDirection meanOf(const glm::dvec4& sum) {
  const double length = glm::length(glm::dvec3(sum));
  if (!(length > 1e-15)) return {};
  return {glm::dvec3(sum) / length, sum.w > 0.0 ? std::min(1.0, length / sum.w) : 0.0};
}

double ballFormFactor(double cosine, double sine) {
  if (!(sine > 0.0) || cosine <= -sine) return 0.0;
  if (cosine >= sine) return std::min(1.0, sine * sine * cosine);
  // Only the part above the horizon counts; h = 1 / sine, k = sqrt(h^2 - 1).
  const double h = 1.0 / sine, k = std::sqrt(std::max(0.0, h * h - 1.0));
  const double across = std::sqrt(std::max(1e-12, 1.0 - cosine * cosine));
  const double rim = std::asin(std::clamp(k / (h * across), -1.0, 1.0));
  const double arc = std::acos(std::clamp(-k * cosine / across, -1.0, 1.0));
  const double chord = k * std::sqrt(std::max(0.0, 1.0 - h * h * cosine * cosine));
  const double factor = 0.5 - rim / std::numbers::pi + (cosine * arc - chord) / (std::numbers::pi * h * h);
  return std::clamp(factor, 0.0, 1.0);
}

}  // namespace prelight
