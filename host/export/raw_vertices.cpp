#include "export/raw_vertices.h"

#include <span>
#include <string>

#include "export/raw_transfer.h"

namespace prelight {

namespace {

void addTransfer(const std::optional<HarmonicTransfer>& transfer, const char* name, std::size_t vertices,
                 RawArrays& arrays) {
  if (!transfer) return;
  const auto channels = static_cast<std::size_t>(transfer->channels);
  const auto columns = static_cast<std::size_t>(transfer->order * transfer->order);
  arrays.add(name, transfer->coefficients, {vertices, channels, columns}, "vertex, channel, function",
             "T: exit radiance is albedo x sum L_i T_i of a far light's coefficients L");
}

}  // namespace

nlohmann::ordered_json addRawVertices(const CompiledScene& scene, const Bake& bake, RawArrays& arrays) {
  const std::size_t vertices = scene.vertexCount();
  if (!bake.ao.empty())
    arrays.add("ao", bake.ao, {vertices}, "vertex", "cosine-weighted accessibility, 1 = open");
  if (!bake.bentNormals.empty())
    arrays.add("bentNormal", std::span(&bake.bentNormals[0].x, 3 * vertices), {vertices, 3},
               "vertex, coordinate", "unit, world space");
  if (bake.irradiance)
    arrays.add("irradiance", std::span(&(*bake.irradiance)[0].x, 3 * vertices), {vertices, 3},
               "vertex, channel", "of the scene's own lights, W/m2");
  addTransfer(bake.sh, "sh", vertices, arrays);
  addTransfer(bake.ch, "ch", vertices, arrays);
  nlohmann::ordered_json primitives = nlohmann::ordered_json::array();
  for (const PrimitiveRange& range : scene.primitives)
    primitives.push_back({{"node", range.node},
                          {"primitive", range.primitive},
                          {"instance", range.instance},
                          {"firstVertex", range.firstVertex},
                          {"vertexCount", range.vertexCount}});
  nlohmann::ordered_json description = {
      {"version", 1},
      {"contents",
       "baked data of the vertices, in the order of the file's own vertices, primitive after primitive"},
      {"primitives", primitives}};
  if (bake.haar) description["haar"] = addRawWavelets(*bake.haar, arrays);
  if (bake.occluders) description["vo"] = addRawOccluders(*bake.occluders, arrays);
  if (bake.compressedSh) description["shCompressed"] = addRawCompressed(*bake.compressedSh, arrays);
  return description;
}

}  // namespace prelight
