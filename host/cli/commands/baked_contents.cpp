#include "cli/commands/baked_contents.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "techniques/registry/registry.h"

namespace prelight::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Returns a text such as "2.1 MiB, 312 bytes per vertex".
std::string sizeText(std::size_t bytes, std::size_t vertices) {
  const double each = vertices == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(vertices);
  return fmt::format("{}, {} bytes per vertex", shortBytes(static_cast<double>(bytes)),
                     each < 100.0 ? fmt::format("{:.3g}", each) : fmt::format("{:.0f}", each));
}

}  // namespace

std::vector<BakedTechnique> bakedTechniques(const Bake& bake, std::size_t vertices,
                                            const QuantizedBytes& quantized) {
  std::vector<BakedTechnique> found;
  for (BakedSummary& summary : summariesOf(bake, vertices)) {
    if (const auto bytes = quantized.find(summary.key); bytes != quantized.end()) {
      summary.text += ", quantised";
      summary.bytes = bytes->second;
      if (!summary.json.is_object()) summary.json = Json::object();  // in place of a plain true
      summary.json["bytes"] = bytes->second;
    }
    const std::string size = summary.perVertex ? sizeText(summary.bytes, vertices)
                                               : shortBytes(static_cast<double>(summary.bytes));
    found.push_back({summary.key, summary.text + "; " + size, std::move(summary.json)});
  }
  return found;
}

Json bakedJson(const Bake& bake, std::size_t vertices, const QuantizedBytes& quantized) {
  Json json = {{"ao", false}, {"bentNormal", false}};
  for (BakedTechnique& technique : bakedTechniques(bake, vertices, quantized))
    json[technique.key] = std::move(technique.json);
  json["generator"] = bake.info.generator;
  json["seed"] = bake.info.seed;
  json["rays"] = bake.info.rays;
  json["error"] = bake.info.error;
  if (!bake.info.visibility.empty()) json["visibility"] = bake.info.visibility;
  return json;
}

std::string bakedOriginText(const BakeInfo& info) {
  const std::string seen = info.visibility.empty() ? shortCount(static_cast<double>(info.rays)) + " rays"
                                                   : "views drawn by " + info.visibility;
  return fmt::format("{}, seed {}, AO error {:.2g}, by {}", seen, info.seed, info.error, info.generator);
}

}  // namespace prelight::cli
