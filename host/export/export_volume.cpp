#include "export/export_volume.h"

#include "base/atomic_file.h"
#include "export/export_readme.h"
#include "export/raw_arrays.h"
#include "techniques/volume/volume_light.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;
using Shape = std::vector<std::size_t>;

constexpr const char* shConvention =
    "real, orthonormal, no Condon-Shortley phase; function l(l+1)+m of world directions x, y, z with polar "
    "axis z: 0.282095, 0.488603 y, 0.488603 z, 0.488603 x, 1.092548 xy, 1.092548 yz, 0.315392 (3 zz - 1), "
    "1.092548 zx, 0.546274 (xx - yy)";

Shape cellsOf(const VolumeGrid& grid, Shape further) {
  Shape shape = {static_cast<std::size_t>(grid.size.z), static_cast<std::size_t>(grid.size.y),
                 static_cast<std::size_t>(grid.size.x)};
  shape.insert(shape.end(), further.begin(), further.end());
  return shape;
}

Json gridToJson(const VolumeGrid& grid) {
  const glm::dvec3 first = voxelCentre(grid, 0);
  return {{"size", {grid.size.x, grid.size.y, grid.size.z}},
          {"first", {first.x, first.y, first.z}},
          {"spacing", grid.cell()},
          {"index", "(z size.y + y) size.x + x, at first + spacing (x, y, z), metres, world space of glTF"}};
}

/// The files of a volume: a binary array, its description and texts.
class VolumeFiles {
 public:
  VolumeFiles(const std::filesystem::path& folder, std::string stem, const ExportRequest& request)
      : folder_(folder), stem_(std::move(stem)), files_(folder, workOf(request)) {}

  void addArrays(const RawArrays& arrays, Json description, const char* contents) {
    description["file"] = stem_ + ".bin";
    description["arrays"] = arrays.json();
    add(stem_ + ".bin", std::as_bytes(std::span(arrays.bytes())), contents);
    addText(stem_ + ".json", description.dump(2) + "\n", "layout of its contents, for programs");
  }

  void addText(const std::string& name, const std::string& text, const std::string& contents) {
    add(name, std::as_bytes(std::span(text)), contents);
  }

  ExportReport finish(const std::string& name, const ExportRequest& request) {
    for (const TextFile& text : volumeTexts(name, report_, request))
      addText(text.name, text.text, text.contents);
    for (ExportedFile& file : report_.files) file.bytes = files_.bytesOf(folder_ / file.name);
    files_.commit();
    return report_;
  }

 private:
  void add(const std::string& name, std::span<const std::byte> bytes, const std::string& contents) {
    files_.add(folder_ / name, bytes);
    report_.files.push_back({name, contents, {}});
  }

  const std::filesystem::path& folder_;
  std::string stem_;
  OutputFiles files_;
  ExportReport report_;
};

}  // namespace

ExportReport exportProbes(const IrradianceVolume& volume, const std::filesystem::path& folder,
                          const std::string& name, const ExportRequest& request) {
  constexpr std::size_t side = IrradianceVolume::surfaceSide;
  RawArrays arrays;
  arrays.add("coefficients", volume.coefficients, cellsOf(volume.grid, {volume.columns(), 3}),
             "z, y, x, function of SH, channel", "incident radiance in SH, W/(m2 sr)");
  arrays.add(
      "surfaces", std::span(&volume.surfaces[0].x, 4 * volume.surfaces.size()),
      cellsOf(volume.grid, {side, side, 4}), "z, y, x, row, column, n.x n.y n.z h",
      "the plane that the probe sees in the direction of an octahedral map's texel: a point is in front of "
      "it where n.(point - place) + h >= 0; 0 0 0 1 where nothing is near");
  arrays.add("places", std::span(&volume.places[0].x, 3 * volume.places.size()), cellsOf(volume.grid, {3}),
             "z, y, x, coordinate",
             "where the probe looks from, m: its place in the grid, or beside the object there");
  arrays.add("valid", volume.valid, cellsOf(volume.grid, {}), "z, y, x",
             "0: in an object; its coefficients are the mean of its neighbours'");
  const Json description = {
      {"version", 1},
      {"contents", "irradiance volume of the scene's own lights"},
      {"grid", gridToJson(volume.grid)},
      {"order", volume.order},
      {"basis", shConvention},
      {"irradiance",
       "E(n) = sum A_l L_lm Y_lm(n) W/m2, A = pi, 2 pi / 3, pi / 4; a diffuse surface reflects "
       "albedo E / pi"},
      {"octahedralMap",
       "d /= |x| + |y| + |z|; where z < 0, (x, y) = ((1 - |y|) sign x, (1 - |x|) sign y); column "
       "(x + 1) / 2, row (y + 1) / 2 of the side"}};
  VolumeFiles files(folder, name + ".probes", request);
  files.addArrays(arrays, description, "light at points in the air, floats");
  return files.finish(name, request);
}

ExportReport exportTransferVolume(const VolumeTransfer& volume, const std::filesystem::path& folder,
                                  const std::string& name, const ExportRequest& request) {
  const auto channels = static_cast<std::size_t>(volume.channels);
  RawArrays arrays;
  arrays.add("coefficients", volume.coefficients, cellsOf(volume.grid, {channels, volume.columns()}),
             "z, y, x, channel, function of SH",
             "T: the mean radiance at the point is sum L_i T_i of a far light's SH L");
  if (!volume.direct.empty())
    arrays.add("direct", volume.direct, cellsOf(volume.grid, {volume.columns()}), "z, y, x, function of SH",
               "T without bounces");
  if (!volume.sent.empty())
    arrays.add("sent", volume.sent, cellsOf(volume.grid, {3, volume.sentBands(), volume.columns()}),
               "z, y, x, channel, function j of direction, function i of the light",
               "radiance of the visible surfaces in SH of the direction, per coefficient of the light");
  if (!volume.lights.empty())
    arrays.add(
        "lights", volume.lights, cellsOf(volume.grid, {3, volume.lightBands(), volume.groups()}),
        "z, y, x, channel, function j of direction, group of lights",
        "transfer of the scene's own lights after at least one reflection, per unit of a group's colour");
  arrays.add("air", volume.air, cellsOf(volume.grid, {}), "z, y, x", "0: in a closed object");
  const Json description = {{"version", 1},
                            {"contents", "transfer of points in the air"},
                            {"grid", gridToJson(volume.grid)},
                            {"order", volume.order},
                            {"channels", volume.channels},
                            {"bounces", volume.bounces},
                            {"basis", shConvention}};
  VolumeFiles files(folder, name + ".volume", request);
  files.addArrays(arrays, description, "transfer of points in the air, floats");
  return files.finish(name, request);
}

}  // namespace prelight
