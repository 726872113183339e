#include "support/parted_rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "charts/light_map_lookup.h"
#include "export/map_picture.h"
#include "gi/global_illumination.h"
#include "gi/probes/probe_light.h"
#include "support/devices.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

struct Partition {
  const char* name;
  double thickness, turn, shift;
  int cells;
};

class PartedRoomsTest : public testing::TestWithParam<Partition> {
 protected:
  PartedRooms rooms() const {
    const Partition& p = GetParam();
    return p.cells == 0 ? partedStoreys(p.thickness) : partedRooms(p.thickness, p.turn, p.shift, p.cells);
  }
};

double brightestInTheDark(const PartedRooms& rooms, const LightMap& map) {
  double most = 0.0;
  rooms.forDarkPlaces([&](std::uint32_t face, double b1, double b2, const glm::dvec3&) {
    if (map.layout.chartOf[face] == LightMapLayout::noChart) return;
    const glm::dvec3 e = lightMapIrradiance(map, face, b1, b2);
    most = std::max({most, e.x, e.y, e.z});
  });
  return most;
}

double meanOfTexels(const LightMap& map) {
  double sum = 0.0;
  for (const LightMapTexel& texel : map.layout.texels)
    sum += static_cast<double>(map.values[3 * static_cast<std::size_t>(map.coefficients) * texel.texel]);
  return sum / static_cast<double>(map.layout.texels.size());
}

TEST_P(PartedRoomsTest, LightMap_IsBlackBeyondTheWallAlsoForPlainFilters) {
  const PartedRooms parted = rooms();
  CompiledScene scene = parted.scene;
  scene.lights = {parted.lamp()};
  BakeRequest request;
  request.lightMap.wanted = true;
  request.lightMap.texelSize = 0.11;
  request.lightMap.photons = 4000;
  request.effort.rays = 64;
  Scene source;
  source.lights = scene.lights;
  Progress progress;
  BakeReport report;
  const Bake bake = bakeScene(scene, request, makePlan(source, scene, request), sharedDevice(), progress,
                              report, nullptr, &source);
  EXPECT_GT(meanOfTexels(*bake.lightMap), 0.1);
  EXPECT_EQ(brightestInTheDark(parted, *bake.lightMap), 0.0);
  EXPECT_EQ(brightestInTheDark(parted, withoutWalls(*bake.lightMap)), 0.0);
}

TEST_P(PartedRoomsTest, GlobalIllumination_IsBlackBeyondTheWall) {
  const PartedRooms parted = rooms();
  const LitScene lit{parted.scene, noImages(), {parted.lamp()}};
  GlobalIlluminationRequest request;
  request.indirect.photons = 4000;
  request.indirect.rays = 64;
  Progress progress;
  const GlobalIllumination light =
      computeGlobalIllumination(Scene{}, lit, request, 4096, sharedDevice(), progress);
  EXPECT_GT(meanOfTexels(light.indirect), 0.1);
  EXPECT_EQ(brightestInTheDark(parted, light.indirect), 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    Walls, PartedRoomsTest,
    testing::Values(Partition{"SheetOnEdgesOfTheFloor", 0.0, 0.0, 0.0, 4},
                    Partition{"SheetAcrossTriangles", 0.0, 0.0, 0.137, 3},
                    Partition{"SheetAskew", 0.0, 0.4, 0.137, 1}, Partition{"Wall20mm", 0.02, 0.0, 0.0, 4},
                    Partition{"Wall20mmAskew", 0.02, 0.3, -0.07, 2}, Partition{"Wall100mm", 0.1, 0.0, 0.0, 4},
                    Partition{"Wall100mmAskew", 0.1, 0.7, 0.05, 1}, Partition{"Wall300mm", 0.3, 0.0, 0.1, 4},
                    Partition{"Slab20mm", 0.02, 0.0, 0.0, 0}, Partition{"Slab100mm", 0.1, 0.0, 0.0, 0}),
    [](const auto& tried) { return std::string(tried.param.name); });

}  // namespace
}  // namespace prelight::test
