#include "techniques/sh/harmonics.h"

#include <fmt/format.h>

#include "basis/ch.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"

namespace prelight {

PlannedPass planHarmonics(Pass name, int order, bool colored, const std::string& how) {
  if (order == 0) return {name, false, "not asked for"};
  return {
      name, true,
      fmt::format("order {}, {} coefficients, {}{}", order, order * order, plannedChannels(colored), how)};
}

HarmonicTransfer shTransfer(const BakeContext& context, const SlotTransfer& transfer,
                            const SlotValues& values) {
  const int order = context.request.sh.order;
  const auto n = static_cast<std::size_t>(order * order);
  return {order, transfer.channels(), transfer.bounces,
          packRows(context.mesh, values, context.scene, transfer.channels(), n,
                   [&](const float* row, float* out) {
                     for (std::size_t i = 0; i < n; ++i) out[i] = finiteOr(row[i], 0.0f);
                   }),
          false};
}

HarmonicTransfer chTransfer(const BakeContext& context, const SlotTransfer& transfer,
                            const SlotValues& values) {
  const ChRequest& request = context.request.ch;
  const auto n = static_cast<std::size_t>(request.order * request.order);
  const ch::Basis basis(request.order);
  std::vector<double> sh(n), coefficients(n);
  const auto write = [&](const float* row, float* out) {
    sh.assign(row, row + n);
    request.naive ? basis.momentsFromSh(sh, coefficients) : basis.fromSh(sh, coefficients);
    for (std::size_t i = 0; i < n; ++i) out[i] = finiteOr(coefficients[i], 0.0f);
  };
  return {request.order, transfer.channels(), transfer.bounces,
          packRows(context.mesh, values, context.scene, transfer.channels(), n, write), request.naive};
}

namespace {

/// Returns everything but the coefficients.
nlohmann::ordered_json headerToJson(const HarmonicTransfer& transfer) {
  nlohmann::ordered_json json = {
      {"order", transfer.order}, {"channels", transfer.channels}, {"bounces", transfer.bounces}};
  if (transfer.naive) json["projection"] = "naive";
  return json;
}

}  // namespace

nlohmann::ordered_json harmonicToJson(GltfDocument& document, const HarmonicTransfer& transfer,
                                      const PrimitiveRanges& ranges) {
  const auto width = static_cast<std::size_t>(transfer.order * transfer.order * transfer.channels);
  nlohmann::ordered_json json = headerToJson(transfer);
  json["coefficients"] = appendVertices(document, transfer.coefficients, ranges, width);
  return json;
}

nlohmann::ordered_json harmonicToJson(const BakedOutput& output, std::string_view name,
                                      const HarmonicTransfer& transfer, const PrimitiveRanges& ranges) {
  const auto row = static_cast<std::size_t>(transfer.order * transfer.order);
  nlohmann::ordered_json json = headerToJson(transfer);
  json["coefficients"] =
      output.column(name, transfer.coefficients, ranges, row * static_cast<std::size_t>(transfer.channels),
                    {.square = true, .group = row});
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

std::string layoutOf(const HarmonicTransfer& transfer) {
  return fmt::format("[vertex][channel {}][i] of order {}", transfer.channels, transfer.order);
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
