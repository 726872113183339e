#include "export/export_volume.h"

#include <gmock/gmock.h>

#include <cstring>
#include <numeric>

#include "support/gltf_files.h"

namespace prelight {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

VolumeGrid gridOf(const glm::ivec3& size) {
  return {size, {1.0, 2.0, 3.0}, glm::dvec3(1.0, 2.0, 3.0) + 0.5 * glm::dvec3(size)};
}

/// Numbers that equal their index.
std::vector<float> counted(std::size_t count) {
  std::vector<float> values(count);
  std::iota(values.begin(), values.end(), 0.0f);
  return values;
}

IrradianceVolume madeUp() {
  IrradianceVolume volume;
  volume.grid = gridOf({2, 3, 4});
  volume.order = 2;
  volume.coefficients = counted(24 * 12);
  volume.valid.assign(24, 1);
  volume.valid[23] = 0;
  volume.places.assign(24, glm::vec3(1.5f, 2.5f, 7.0f));
  volume.surfaces.assign(24 * 64, glm::vec4(0.0f, 1.0f, 0.0f, 9.0f));
  return volume;
}

/// An array of a file, found by its description.
template <class T>
std::vector<T> arrayOf(const Json& description, const std::string& bytes, const char* name) {
  const Json& array = description.at("arrays").at(name);
  std::size_t count = 1;
  for (const Json& side : array.at("shape")) count *= side.get<std::size_t>();
  std::vector<T> values(count);
  std::memcpy(values.data(), &bytes.at(array.at("byteOffset").get<std::size_t>()), count * sizeof(T));
  return values;
}

TEST(ExportProbes, Numbers_AreWhereTheDescriptionSays) {
  const IrradianceVolume volume = madeUp();
  const test::TemporaryFolder folder;
  ExportRequest request;
  request.form = ExportForm::Probes;
  exportProbes(volume, folder.path(), "room", request);
  const Json description = Json::parse(test::readBytes(folder / "room.probes.json"));
  const std::string bytes = test::readBytes(folder / description["file"].get<std::string>());
  EXPECT_EQ(description["arrays"]["coefficients"]["shape"], Json({4, 3, 2, 4, 3}));
  EXPECT_EQ(arrayOf<float>(description, bytes, "coefficients"), volume.coefficients);
  EXPECT_EQ(arrayOf<std::uint8_t>(description, bytes, "valid"), volume.valid);
  EXPECT_EQ(arrayOf<float>(description, bytes, "surfaces")[3], 9.0f);
  EXPECT_EQ(arrayOf<float>(description, bytes, "places")[71], 7.0f);
  EXPECT_EQ(description["grid"]["first"], Json({1.25, 2.25, 3.25}));
  EXPECT_EQ(description["grid"]["spacing"], 0.5);
}

TEST(ExportProbes, Targets_GetTheirLoaderAndAReadme) {
  for (const ExportTarget target : {ExportTarget::Gltf, ExportTarget::Three, ExportTarget::Raw}) {
    const test::TemporaryFolder folder;
    ExportRequest request;
    request.form = ExportForm::Probes;
    request.target = target;
    const ExportReport report = exportProbes(madeUp(), folder.path(), "room", request);
    EXPECT_EQ(std::filesystem::exists(folder / "prelight_probes.js"), target != ExportTarget::Raw);
    for (const ExportedFile& file : report.files) EXPECT_TRUE(std::filesystem::exists(folder / file.name));
    const std::string readme = test::readBytes(folder / "README.probes.md");
    EXPECT_THAT(readme, HasSubstr("room.probes.json"));
    EXPECT_EQ(readme.find("{N"), std::string::npos) << "all marks are filled in";
  }
}

TEST(ExportTransferVolume, Numbers_AreWhereTheDescriptionSays) {
  VolumeTransfer volume;
  volume.grid = gridOf({2, 2, 2});
  volume.order = 2;
  volume.channels = 3;
  volume.bounces = 1;
  volume.coefficients = counted(8 * 12);
  volume.direct = counted(8 * 4);
  volume.air.assign(8, 1);
  volume.sentOrder = 2;
  volume.sent = counted(8 * 3 * 4 * 4);
  const test::TemporaryFolder folder;
  ExportRequest request;
  request.form = ExportForm::Volume;
  exportTransferVolume(volume, folder.path(), "air", request);
  const Json description = Json::parse(test::readBytes(folder / "air.volume.json"));
  const std::string bytes = test::readBytes(folder / "air.volume.bin");
  for (const auto& [name, values] :
       {std::pair{"coefficients", volume.coefficients}, {"direct", volume.direct}, {"sent", volume.sent}})
    EXPECT_EQ(arrayOf<float>(description, bytes, name), values);
  EXPECT_FALSE(description["arrays"].contains("lights"));
  EXPECT_EQ(description["channels"], 3);
  EXPECT_TRUE(std::filesystem::exists(folder / "README.volume.md"));
}

}  // namespace
}  // namespace prelight
