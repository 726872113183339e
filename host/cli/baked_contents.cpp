#include "cli/baked_contents.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/console.h"

namespace prelight::cli {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
std::size_t bytesOf(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::string counted(std::size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

/// "3 channels, 1 bounce".
std::string channelsText(int channels, int bounces) {
  return counted(static_cast<std::size_t>(channels), "channel") + ", " +
         counted(static_cast<std::size_t>(bounces), "bounce");
}

double perVertex(std::size_t bytes, std::size_t vertices) {
  return vertices == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(vertices);
}

/// "2.1 MiB, 312 bytes a vertex".
std::string sizeText(std::size_t bytes, std::size_t vertices) {
  const double each = perVertex(bytes, vertices);
  return fmt::format("{}, {} bytes a vertex", shortBytes(static_cast<double>(bytes)),
                     each < 100.0 ? fmt::format("{:.3g}", each) : fmt::format("{:.0f}", each));
}

BakedTechnique describe(const HarmonicTransfer& transfer, const char* key, const char* name,
                        std::size_t vertices) {
  const std::size_t bytes = bytesOf(transfer.coefficients);
  Json json = {{"order", transfer.order},
               {"channels", transfer.channels},
               {"bounces", transfer.bounces},
               {"bytes", bytes}};
  if (transfer.naive) json["naive"] = true;
  return {key,
          fmt::format("{} of order {}, {}{}; {}", name, transfer.order,
                      channelsText(transfer.channels, transfer.bounces),
                      transfer.naive ? ", projected naively" : "", sizeText(bytes, vertices)),
          std::move(json)};
}

BakedTechnique describe(const CompressedTransfer& transfer, std::size_t vertices) {
  const std::string method = compressionName({.method = transfer.method,
                                              .clusters = transfer.clusters,
                                              .components = transfer.components,
                                              .weights = transfer.weights});
  const std::size_t bytes = transfer.byteCount();
  return {
      "shCompressed",
      fmt::format("SH of order {} as {}, {}; {}", transfer.order, method,
                  channelsText(transfer.channels, transfer.bounces), sizeText(bytes, vertices)),
      {{"method", method},
       {"order", transfer.order},
       {"channels", transfer.channels},
       {"bounces", transfer.bounces},
       {"bytes", bytes},
       {"bytesPerVertex", vertices == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(vertices)}}};
}

BakedTechnique describe(const HaarTransfer& transfer, std::size_t vertices) {
  const std::size_t bytes = bytesOf(transfer.offsets) +
                            transfer.indices.size() * transfer.storedIndexBytes() + bytesOf(transfer.values);
  const std::size_t rows = transfer.offsets.empty() ? 0 : transfer.offsets.size() - 1;
  const double mean =
      rows == 0 ? 0.0 : static_cast<double>(transfer.values.size()) / static_cast<double>(rows);
  return {"haar",
          fmt::format("Haar wavelets on 6 x {0} x {0} texels, {1}; {2:.1f} of {3} coefficients a row; {4}",
                      transfer.faceSize, channelsText(transfer.channels, transfer.bounces), mean,
                      6 * transfer.faceSize * transfer.faceSize, sizeText(bytes, vertices)),
          {{"faceSize", transfer.faceSize},
           {"channels", transfer.channels},
           {"bounces", transfer.bounces},
           {"coefficientsPerRow", mean},
           {"bytes", bytes}}};
}

BakedTechnique describe(const GlossyTransfer& transfer, std::size_t vertices) {
  const std::size_t bytes = bytesOf(transfer.matrices);
  return {"glossy",
          fmt::format("glossy matrices of order {}, {}; {}", transfer.order,
                      channelsText(transfer.channels, transfer.bounces), sizeText(bytes, vertices)),
          {{"order", transfer.order},
           {"channels", transfer.channels},
           {"bounces", transfer.bounces},
           {"bytes", bytes}}};
}

BakedTechnique describe(const LightGroupTransfer& transfer, std::size_t vertices) {
  const std::size_t bytes = bytesOf(transfer.coefficients);
  std::string names;
  Json groups = Json::array();
  for (const LightGroup& group : transfer.groups) {
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", group.name);
    groups.push_back({{"name", group.name}, {"color", {group.color.x, group.color.y, group.color.z}}});
  }
  return {"lightGroups",
          fmt::format("{} {}, {}; {}", counted(transfer.groups.size(), "light group"), names,
                      channelsText(transfer.channels, transfer.bounces), sizeText(bytes, vertices)),
          {{"groups", std::move(groups)},
           {"channels", transfer.channels},
           {"bounces", transfer.bounces},
           {"bytes", bytes}}};
}

BakedTechnique describe(const VolumeTransfer& transfer) {
  const VolumeGrid& grid = transfer.grid;
  const std::size_t bytes = bytesOf(transfer.coefficients) + bytesOf(transfer.direct) + bytesOf(transfer.air);
  const auto inside = static_cast<std::size_t>(
      std::count(transfer.air.begin(), transfer.air.end(), static_cast<std::uint8_t>(0)));
  return {
      "volume",
      fmt::format("volume of {} x {} x {} cells, {:.3g} wide, {} of them inside objects; SH of order {}, "
                  "{}; {}",
                  grid.size.x, grid.size.y, grid.size.z, grid.cell(), inside, transfer.order,
                  channelsText(transfer.channels, transfer.bounces), shortBytes(static_cast<double>(bytes))),
      {{"size", {grid.size.x, grid.size.y, grid.size.z}},
       {"min", {grid.min.x, grid.min.y, grid.min.z}},
       {"max", {grid.max.x, grid.max.y, grid.max.z}},
       {"insideCells", inside},
       {"order", transfer.order},
       {"channels", transfer.channels},
       {"bounces", transfer.bounces},
       {"bytes", bytes}}};
}

BakedTechnique describe(const OccluderTransfer& transfer, std::size_t vertices) {
  const std::size_t bytes =
      bytesOf(transfer.offsets) + bytesOf(transfer.occluders) + bytesOf(transfer.vectors);
  const double records = perVertex(transfer.recordCount(), vertices);
  Json stored = Json::array();
  std::string names;
  for (const OccluderVector vector : transfer.stored) {
    const std::string_view name = occluderVectorNames[static_cast<std::size_t>(vector)];
    stored.push_back(name);
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  }
  return {
      "vo",
      fmt::format("{}, {:.1f} records a vertex of {}; {}", counted(transfer.names.size(), "vector occluder"),
                  records, names, sizeText(bytes, vertices)),
      {{"occluders", transfer.names.size()},
       {"recordsPerVertex", records},
       {"stored", std::move(stored)},
       {"bytes", bytes}}};
}

BakedTechnique describe(const ChartTransfer& transfer) {
  std::size_t bytes = 0, texels = 0;
  int most = 0;
  for (const ChartTransfer::Map& map : transfer.maps) {
    bytes += bytesOf(map.coefficients);
    texels += static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    most = std::max({most, map.width, map.height});
  }
  return {
      "texels",
      fmt::format("{} of at most {} texels a side, {} texels in all; SH of order {}, {}; {}",
                  counted(transfer.maps.size(), "light map"), most, texels, transfer.order,
                  channelsText(transfer.channels, transfer.bounces), shortBytes(static_cast<double>(bytes))),
      {{"maps", transfer.maps.size()},
       {"largestSide", most},
       {"texels", texels},
       {"order", transfer.order},
       {"channels", transfer.channels},
       {"bounces", transfer.bounces},
       {"bytes", bytes}}};
}

BakedTechnique describe(const LightMap& map) {
  const LightMapLayout& layout = map.layout;
  const std::size_t bytes = bytesOf(map.values);
  return {"lightMap",
          fmt::format("light map of {} x {} texels, {} charts, {} texels on the surface{}; {}", layout.width,
                      layout.height, layout.chartCount, layout.texels.size(),
                      map.coefficients > 1 ? ", with radiance for bump maps" : "",
                      shortBytes(static_cast<double>(bytes))),
          {{"width", layout.width},
           {"height", layout.height},
           {"charts", layout.chartCount},
           {"texels", layout.texels.size()},
           {"coefficients", map.coefficients},
           {"bytes", bytes}}};
}

BakedTechnique describe(const AnimatedTransfer& transfer, std::size_t vertices) {
  std::size_t bytes = 0;
  for (const HarmonicTransfer& key : transfer.keys) bytes += bytesOf(key.coefficients);
  std::string times;
  for (const double time : transfer.times) times += fmt::format("{}{:g}", times.empty() ? "" : ", ", time);
  return {"animation",
          fmt::format("{} of animation {} at {} s; {}", counted(transfer.times.size(), "key"),
                      transfer.animation, times, sizeText(bytes, vertices)),
          {{"index", transfer.animation}, {"times", transfer.times}, {"bytes", bytes}}};
}

}  // namespace

std::vector<BakedTechnique> bakedTechniques(const Bake& bake, std::size_t vertices) {
  std::vector<BakedTechnique> found;
  if (!bake.ao.empty()) found.push_back({"ao", "AO; " + sizeText(bytesOf(bake.ao), vertices), true});
  if (!bake.bentNormals.empty())
    found.push_back({"bentNormal", "bent normals; " + sizeText(bytesOf(bake.bentNormals), vertices), true});
  if (bake.irradiance)
    found.push_back({"irradiance",
                     "irradiance of static lights; " + sizeText(bytesOf(*bake.irradiance), vertices), true});
  if (bake.sh) found.push_back(describe(*bake.sh, "sh", "SH", vertices));
  if (bake.compressedSh) found.push_back(describe(*bake.compressedSh, vertices));
  if (bake.ch) found.push_back(describe(*bake.ch, "ch", "CH", vertices));
  if (bake.haar) found.push_back(describe(*bake.haar, vertices));
  if (bake.glossy) found.push_back(describe(*bake.glossy, vertices));
  if (bake.lightGroups) found.push_back(describe(*bake.lightGroups, vertices));
  if (bake.occluders) found.push_back(describe(*bake.occluders, vertices));
  if (bake.volume) found.push_back(describe(*bake.volume));
  if (bake.texels) found.push_back(describe(*bake.texels));
  if (bake.lightMap) found.push_back(describe(*bake.lightMap));
  if (bake.animation) found.push_back(describe(*bake.animation, vertices));
  return found;
}

Json bakedJson(const Bake& bake, std::size_t vertices) {
  Json json = {{"ao", false}, {"bentNormal", false}};
  for (BakedTechnique& technique : bakedTechniques(bake, vertices))
    json[technique.key] = std::move(technique.json);
  json["generator"] = bake.info.generator;
  json["seed"] = bake.info.seed;
  json["rays"] = bake.info.rays;
  json["error"] = bake.info.error;
  return json;
}

std::string bakedOriginText(const BakeInfo& info) {
  return fmt::format("{} rays, seed {}, AO error {:.2g}, by {}", shortCount(static_cast<double>(info.rays)),
                     info.seed, info.error, info.generator);
}

}  // namespace prelight::cli
