#include "scene/builtin/builtin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "prelight/error.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

CompiledScene compileBuiltin(const std::string& name) {
  Warnings warnings;
  const CompiledScene scene = compileScene(loadScene(makeBuiltinScene(name), warnings), warnings);
  EXPECT_TRUE(warnings.empty()) << name << ": " << warnings.front();
  return scene;
}

/// Six times the signed volume that the triangles of a primitive enclose around its own centre; positive if
/// they face outwards.
double signedVolume(const CompiledScene& scene, const PrimitiveRange& range) {
  double volume = 0.0;
  const glm::dvec3 centre(scene.positions[range.firstVertex]);
  for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
    volume += glm::dot(geometricNormal(scene, t), glm::dvec3(scene.positions[scene.triangles[t].x]) - centre);
  }
  return volume;
}

/// Number of edges, compared by position, that no triangle traverses in the other direction.
std::size_t openEdges(const CompiledScene& scene, const PrimitiveRange& range) {
  using Point = std::tuple<float, float, float>;
  std::map<std::pair<Point, Point>, int> balance;
  const auto point = [&](std::uint32_t v) {
    const glm::vec3& p = scene.positions[v];
    return Point{p.x, p.y, p.z};
  };
  for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const Point a = point(scene.triangles[t][corner]);
      const Point b = point(scene.triangles[t][(corner + 1) % 3]);
      if (a < b) {
        ++balance[{a, b}];
      } else {
        --balance[{b, a}];
      }
    }
  }
  std::size_t open = 0;
  for (const auto& [edge, count] : balance) open += count != 0 ? 1 : 0;
  return open;
}

TEST(BuiltinScenes, All_SurviveWritingAndReading) {
  const test::TemporaryFolder folder;
  for (const BuiltinScene& builtin : builtinScenes()) {
    const GltfDocument document = makeBuiltinScene(builtin.name);
    writeGlb(folder / "scene.glb", document);
    Warnings warnings;
    const GltfDocument copy = readGltf(folder / "scene.glb", warnings);
    EXPECT_EQ(copy.json, document.json) << builtin.name;
    EXPECT_TRUE(warnings.empty());
    for (const auto& node : copy.json["nodes"]) EXPECT_FALSE(node.value("name", "").empty());
  }
}

TEST(BuiltinScenes, All_HaveOneCameraAndTheirLights) {
  const std::map<std::string, std::size_t> several = {{"crowd", 20}, {"ocean", 8}, {"lake", 3}, {"salon", 2}};
  for (const BuiltinScene& builtin : builtinScenes()) {
    Warnings warnings;
    const Scene scene = loadScene(makeBuiltinScene(builtin.name), warnings);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_GT(scene.cameras[0].aspect, 0.0);
    std::size_t lights = scene.lights.size();
    for (const Material& material : scene.materials) lights += material.isEmissive() ? 1 : 0;
    const auto listed = several.find(builtin.name);
    EXPECT_EQ(lights, listed == several.end() ? 1u : listed->second) << builtin.name;
  }
}

const CompiledScene& compiledSalon() {
  static const CompiledScene salon = compileBuiltin("salon");
  return salon;
}

TEST(BuiltinScenes, Counts_AreAsDocumented) {
  const CompiledScene shapes = compileBuiltin("shapes");
  EXPECT_EQ(shapes.triangleCount(), 9800u);
  EXPECT_EQ(shapes.vertexCount(), 5232u);
  EXPECT_EQ(shapes.primitives.size(), 6u);
  EXPECT_EQ(compileBuiltin("cornell").triangleCount(), 13122u);
  EXPECT_EQ(compileBuiltin("caustics").triangleCount(), 13378u);
  EXPECT_EQ(compileBuiltin("rooms").triangleCount(), 8536u);
  EXPECT_EQ(compiledSalon().triangleCount(), 196476u);
}

TEST(BuiltinScenes, ShapesAndGlass_AreClosedAndFaceOutwards) {
  const CompiledScene shapes = compileBuiltin("shapes");
  for (std::size_t i = 1; i < shapes.primitives.size(); ++i) {
    EXPECT_GT(signedVolume(shapes, shapes.primitives[i]), 0.0) << i;
    EXPECT_EQ(openEdges(shapes, shapes.primitives[i]), 0u) << i;
  }
  const CompiledScene caustics = compileBuiltin("caustics");
  EXPECT_GT(signedVolume(caustics, caustics.primitives[6]), 0.0);
  EXPECT_EQ(openEdges(caustics, caustics.primitives[6]), 0u);
}

/// Every object of `ocean` and `lake` but floor and water is closed.
TEST(BuiltinScenes, ObjectsInWater_AreClosedAndFaceOutwards) {
  for (const char* name : {"ocean", "lake"}) {
    const CompiledScene scene = compileBuiltin(name);
    std::size_t closed = 0;
    for (const PrimitiveRange& range : scene.primitives) {
      if (openEdges(scene, range) != 0) continue;
      EXPECT_GT(signedVolume(scene, range), 0.0) << name;
      ++closed;
    }
    EXPECT_EQ(closed, scene.primitives.size() - 2) << name;
  }
}

TEST(BuiltinScenes, Shiny_IsShapesWithOtherMaterials) {
  const CompiledScene shiny = compileBuiltin("shiny"), shapes = compileBuiltin("shapes");
  EXPECT_EQ(shiny.positions, shapes.positions);
  EXPECT_EQ(shiny.triangles, shapes.triangles);
  Warnings warnings;
  for (const Material& material : loadScene(makeBuiltinScene("shapes"), warnings).materials)
    EXPECT_EQ(material.specular + material.metallic, 0.0f);
  for (const Material& material : loadScene(makeBuiltinScene("shiny"), warnings).materials)
    EXPECT_EQ(material.specular + material.metallic, 1.0f);
}

TEST(BuiltinScenes, ShadingAndGeometricNormals_Agree) {
  for (const BuiltinScene& builtin : builtinScenes()) {
    const CompiledScene scene = compileBuiltin(builtin.name);
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
      for (int corner = 0; corner < 3; ++corner) {
        ASSERT_GT(glm::dot(geometricNormal(scene, t), glm::dvec3(scene.normals[scene.triangles[t][corner]])),
                  0.0)
            << builtin.name << " triangle " << t;
      }
    }
  }
}

/// All parts of `salon` are closed but sheets: surfaces of the buildings and the ground, panes, cloth,
/// leaves, branches and the cones of the lamp's shade.
TEST(BuiltinScenes, ObjectsOfTheSalon_AreClosedAndFaceOutwards) {
  const std::set<std::string> sheets = {"Floor",
                                        "Walls",
                                        "Ceiling",
                                        "Left curtain",
                                        "Right curtain",
                                        "Mirror",
                                        "Picture",
                                        "Lamp shade",
                                        "Twigs",
                                        "Inside of the shade",
                                        "Rims of the shade",
                                        "Twig leaves",
                                        "Paving",
                                        "Court walls",
                                        "Gate wall",
                                        "Garden",
                                        "Trunks",
                                        "Olive leaves",
                                        "Hedge leaves",
                                        "Ivy"};
  const CompiledScene& salon = compiledSalon();
  for (const PrimitiveRange& range : salon.primitives) {
    const std::string node = range.name.substr(0, range.name.find('/'));
    if (sheets.contains(node)) continue;
    EXPECT_GT(signedVolume(salon, range), 0.0) << range.name;
    EXPECT_EQ(openEdges(salon, range), 0u) << range.name;
  }
}

/// Nothing that stands in the room of `salon` reaches through its floor or its ceiling.
TEST(BuiltinScenes, FurnitureOfTheSalon_StandsOnItsFloor) {
  const CompiledScene& salon = compiledSalon();
  for (const char* name : {"Bookcase", "Console", "Armchair", "Armchair legs", "Chair", "Table", "Rug"}) {
    const auto range =
        std::find_if(salon.primitives.begin(), salon.primitives.end(), [&](const PrimitiveRange& r) {
          return r.name == name || r.name.starts_with(std::string(name) + "/");
        });
    ASSERT_NE(range, salon.primitives.end()) << name;
    double low = 1e9, high = -1e9;
    for (std::uint32_t v = range->firstVertex; v < range->firstVertex + range->vertexCount; ++v) {
      const double y = static_cast<double>(salon.positions[v].y) + salon.origin.y;
      low = std::min(low, y);
      high = std::max(high, y);
    }
    EXPECT_GE(low, 0.0) << name;
    EXPECT_LT(high, 3.0) << name;
  }
}

TEST(BuiltinScenes, Salon_IsTheSameEachTime) {
  EXPECT_TRUE(makeBuiltinScene("salon").bin == makeBuiltinScene("salon").bin);
}

/// From a point inside, every wall shows its front.
TEST(BuiltinScenes, RoomWalls_FaceTheInside) {
  const CompiledScene cornell = compileBuiltin("cornell");
  for (std::size_t i = 0; i < 6; ++i) {
    const PrimitiveRange& range = cornell.primitives[i];
    for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
      ASSERT_LT(glm::dot(geometricNormal(cornell, t), glm::dvec3(cornell.positions[cornell.triangles[t].x])),
                0.0);
    }
  }
  const CompiledScene rooms = compileBuiltin("rooms");
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::dvec3 inside(i < 3 ? -2.1 : 2.1, 0.0, 0.0);
    const PrimitiveRange& range = rooms.primitives[i];
    for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
      const glm::dvec3 corner(rooms.positions[rooms.triangles[t].x]);
      ASSERT_LT(glm::dot(geometricNormal(rooms, t), corner - inside), 0.0)
          << "node " << i << " triangle " << t;
    }
  }
}

/// The two rooms and the doorway form one closed surface: no light can enter.
TEST(BuiltinScenes, RoomsWithTheirDoorway_AreClosed) {
  const CompiledScene rooms = compileBuiltin("rooms");
  PrimitiveRange shell = rooms.primitives[0];
  for (std::size_t i = 1; i < 7; ++i) shell.triangleCount += rooms.primitives[i].triangleCount;
  EXPECT_EQ(openEdges(rooms, shell), 0u);
}

TEST(BuiltinScenes, SealedRooms_HaveNoOpening) {
  const CompiledScene rooms = compileBuiltin("rooms-sealed");
  PrimitiveRange shell = rooms.primitives[0];
  for (std::size_t i = 1; i < 8; ++i) shell.triangleCount += rooms.primitives[i].triangleCount;
  EXPECT_EQ(openEdges(rooms, shell), 0u);
  for (std::size_t i = 0; i < 8; ++i) {
    const PrimitiveRange& range = rooms.primitives[i];
    double least = 1e9, most = -1e9;
    for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
      const double x = static_cast<double>(rooms.positions[v].x) + rooms.origin.x;
      least = std::min(least, x);
      most = std::max(most, x);
    }
    EXPECT_TRUE(most < 0.0 || least > 0.0) << range.name;  // The wall's inside is at x = 0.
  }
}

/// If an object pierced a wall or the floor, half of its inside would be outside, which matters most for
/// glass.
TEST(BuiltinScenes, ObjectsOfCornellsRoom_StandWithinItsWalls) {
  for (const char* name : {"cornell", "caustics"}) {
    const CompiledScene scene = compileBuiltin(name);
    for (std::size_t i = 6; i < scene.primitives.size(); ++i) {
      const PrimitiveRange& range = scene.primitives[i];
      for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
        const glm::dvec3 p = glm::dvec3(scene.positions[v]) + scene.origin;
        ASSERT_LT(std::max(std::abs(p.x), std::abs(p.z)), 1.0) << name << ", " << range.name;
        ASSERT_GE(p.y, 0.0) << name << ", " << range.name;
        ASSERT_LT(p.y, 1.99) << name << ", " << range.name;  // The lamp's height.
      }
    }
  }
}

TEST(BuiltinScenes, UnknownName_ListsTheKnownOnes) {
  try {
    makeBuiltinScene("sponza");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("shapes, cornell, caustics, rooms"), std::string::npos);
  }
}

}  // namespace
}  // namespace prelight
