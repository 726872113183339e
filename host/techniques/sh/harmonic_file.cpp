#include "techniques/sh/harmonic_file.h"

#include <fmt/format.h>

#include "io/values/append_values.h"
#include "io/values/vertex_values.h"
#include "techniques/summary_text.h"

namespace prelight {

nlohmann::ordered_json harmonicToJson(GltfDocument& document, const HarmonicTransfer& transfer,
                                      const PrimitiveRanges& ranges) {
  const auto width = static_cast<std::size_t>(transfer.order * transfer.order * transfer.channels);
  nlohmann::ordered_json json = {
      {"order", transfer.order}, {"channels", transfer.channels}, {"bounces", transfer.bounces}};
  if (transfer.naive) json["projection"] = "naive";
  json["coefficients"] = appendVertices(document, transfer.coefficients, ranges, width);
  return json;
}

void readHarmonic(const ValueReader& values, const JsonCursor& json, const PrimitiveRanges& ranges,
                  const CompiledScene& scene, std::optional<HarmonicTransfer>& target) {
  HarmonicTransfer header;
  header.order = readNumber(json.at("order"), 1, maxStoredOrder);
  header.channels = readChannels(json);
  header.bounces = readBounces(json);
  header.naive = json.stringOr("projection", "") == "naive";
  if (!target) target = header;
  expectSame(json,
             header.order == target->order && header.channels == target->channels &&
                 header.bounces == target->bounces && header.naive == target->naive,
             "order, channels and bounces");
  const auto width = static_cast<std::size_t>(header.order * header.order * header.channels);
  placeVertices(values.floats(json.at("coefficients"), "SCALAR", vertexCount(ranges) * width), ranges, width,
                scene, target->coefficients);
}

BakedSummary summaryOf(const HarmonicTransfer& transfer, const char* key, const char* name) {
  const std::size_t bytes = bytesOf(transfer.coefficients);
  nlohmann::ordered_json json = {{"order", transfer.order},
                                 {"channels", transfer.channels},
                                 {"bounces", transfer.bounces},
                                 {"bytes", bytes}};
  if (transfer.naive) json["naive"] = true;
  return {key,
          fmt::format("{} of order {}, {}{}", name, transfer.order,
                      channelsText(transfer.channels, transfer.bounces),
                      transfer.naive ? ", projected naively" : ""),
          bytes, true, std::move(json)};
}

}  // namespace prelight
