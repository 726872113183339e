// Features of materials that paths leave out, and whether docs/materials.md says the same.
#include "scene/dropped_features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>
#include <sstream>

#include "support/scenes.h"

namespace prelight {
namespace {

using testing::HasSubstr;

/// Columns of the table in docs/materials.md: feature, rays, full in OpenGL, bakes, other shadings.
std::map<std::string, std::vector<std::string>> documentedRows() {
  std::ifstream file(PRELIGHT_MATERIALS_DOCUMENT);
  std::map<std::string, std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("| ")) continue;
    std::vector<std::string> cells;
    std::stringstream cellsOf(line.substr(1));
    for (std::string cell; std::getline(cellsOf, cell, '|');) {
      const auto first = cell.find_first_not_of(' ');
      cells.push_back(
          first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    }
    if (!cells.empty()) rows[cells.front()] = cells;
  }
  return rows;
}

TEST(DroppedFeatures, Table_IsThatOfTheDocument) {
  const std::map<std::string, std::string> rowOf = {
      {"clear coats", "clear coat, its normal texture"},
      {"sheen", "sheen"},
      {"anisotropy", "anisotropy"},
      {"iridescence", "iridescence"},
      {"scattering within bodies", "scattering within bodies"},
      {"light through glass", "transmission, smooth"},
  };
  const auto rows = documentedRows();
  constexpr std::array<std::size_t, materialPathCount> columns = {2, 3};  // [MaterialPath].
  for (const DroppedFeature& feature : droppedFeatures()) {
    const auto row = rows.find(rowOf.at(feature.what));
    ASSERT_NE(row, rows.end()) << feature.what;
    for (std::size_t path = 0; path < materialPathCount; ++path) {
      const std::string cell = columns[path] < row->second.size() ? row->second[columns[path]] : "";
      const bool without = cell.empty() || cell == "as without" || cell == "passes no light";
      EXPECT_EQ(feature.droppedBy[path], without) << feature.what << ": " << cell;
    }
  }
}

// All shadings draw the lobes of the model, so that none has an empty cell.
TEST(DroppedFeatures, OtherShadings_LeaveOutNoRowOfTheDocument) {
  for (const auto& [feature, cells] : documentedRows()) {
    if (cells.size() < 5 || feature == "feature" || feature.starts_with("---")) continue;
    EXPECT_FALSE(cells[4].empty() || cells[4].starts_with("as without")) << feature;
  }
}

TEST(DroppedFeatures, Note_NamesThePathTheFeatureAndTheMaterialsOnce) {
  CompiledScene compiled = test::box(1, glm::vec3(-1), glm::vec3(1), false);
  Scene scene;
  scene.materials.resize(compiled.materials.size());
  scene.materials.front().name = "velvet";
  compiled.materials.front().sheen.color = glm::vec3(1.0f);
  Warnings notes;
  noteDroppedFeatures(scene, compiled, MaterialPath::Transfer, "baked transfer", notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], HasSubstr("baked transfer leaves out sheen of \"velvet\""));
  notes.clear();
  noteDroppedFeatures(scene, compiled, MaterialPath::DrawnFull, "full shading", notes);
  EXPECT_TRUE(notes.empty());
}

TEST(DroppedFeatures, MaterialsOfNoTriangle_AreNotNamed) {
  CompiledScene compiled = test::box(1, glm::vec3(-1), glm::vec3(1), false);
  CompiledMaterial coated;
  coated.clearcoat.factor = 1.0f;
  compiled.materials.push_back(coated);
  Warnings notes;
  noteDroppedFeatures({}, compiled, MaterialPath::Transfer, "baked transfer", notes);
  EXPECT_TRUE(notes.empty());
}

}  // namespace
}  // namespace prelight
