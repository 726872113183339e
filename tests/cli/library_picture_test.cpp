#include <gmock/gmock.h>

#include <functional>

#include "cli/cli_test.h"
#include "prelight/draw_options.h"
#include "prelight/load.h"
#include "support/devices.h"

namespace prelight::test {
namespace {

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// draw() of the library, compared with the program's pictures.
class LibraryPicture : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    prelightDone({"scene", "shapes", "-o", path("shapes.glb").string()});
    request_.width = 24;
    request_.height = 16;
    request_.bake.effort.rays = 16;
  }

  LoadedScene scene() const { return load(path("shapes.glb")); }

  /// Expects the same pixels of draw() and of `render` with further arguments.
  void expectSame(const std::vector<std::string>& arguments, const DrawRequest& request) const {
    std::vector<std::string> all = {"render", "shapes.glb", "-o", "a.exr", "--size", "24x16", "--rays", "16"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    prelightDone(all);
    const Picture expected = readPicture(path("a.exr"));
    const Drawing drawing = draw(scene(), request, {.device = &sharedDevice()});
    ASSERT_EQ(drawing.picture.pixels.size(), expected.pixels.size());
    EXPECT_TRUE(drawing.picture.pixels == expected.pixels) << ::testing::PrintToString(arguments);
  }

  DrawRequest request_;
};

TEST_F(LibraryPicture, EveryShading_HasThePixelsOfTheProgram) {
  ASSERT_THAT(shadings(), SizeIs(::testing::Ge(15u)));
  for (const ShadingSummary& one : shadings()) {
    request_.shading = one.shading;
    expectSame({"--shading", std::string(one.name)}, request_);
  }
}

TEST_F(LibraryPicture, Options_HaveThePixelsOfTheProgram) {
  struct Case {
    const char* shading;
    std::vector<std::string> arguments;
    std::function<void(DrawRequest&)> set;
  };
  const std::vector<Case> cases = {
      {"vo",
       {"--shadow-formula", "thesis", "--shadow-strength", "1.5", "--waves", "0.3", "--highlights", "all"},
       [](DrawRequest& r) {
         r.options.occluders.shading.formula = OccluderFormula::Thesis;
         r.options.occluders.shading.shadowStrength = 1.5;
         r.options.occluders.shading.effects.waves = 0.3;
         r.options.occluders.allHighlights = true;
       }},
      {"screen",
       {"--occlusion", "disks", "--occlusion-passes", "2"},
       [](DrawRequest& r) {
         r.options.screenOcclusion.method = OcclusionMethod::Disks;
         r.options.screenOcclusion.passes = 2;
       }},
      {"full",
       {"--spp", "2", "--photons", "4000", "--gather", "cache", "--gather-rays", "64"},
       [](DrawRequest& r) {
         r.full.samples = 2;
         r.full.photons = 4000;
         r.full.gather = GatherChoice::Cache;
         r.full.gatherRays = 64;
       }},
      {"full", {"--rasterised"}, [](DrawRequest& r) { r.full.rasterised = true; }},
      {"instant", {"--virtual-lights", "16"}, [](DrawRequest& r) { r.instant.paths = 16; }},
      {"horizons",
       {"--horizon-softness", "5"},
       [](DrawRequest& r) { r.options.horizonSoftness = glm::radians(5.0); }},
      {"haar", {"--haar-terms", "4"}, [](DrawRequest& r) { r.options.haarTerms = 4; }},
      {"sh",
       {"--env", "preetham:3:35", "--rotate-env", "180", "--caustics", "5000"},
       [](DrawRequest& r) {
         r.skyName = "preetham:3:35";
         r.skyRotation = glm::radians(180.0);
         r.causticPhotons = 5000;
       }},
      {"lightmap", {"--encoding", "ahd"}, [](DrawRequest& r) { r.encoding = "ahd"; }},
      {"phong",
       {"--object", "shapes.glb:0.5,0,0:30:0.3", "--light", "none", "--env", "neutral"},
       [this](DrawRequest& r) {
         r.objects.objects = {{path("shapes.glb"), {0.5, 0.0, 0.0}, 30.0, 0.3}};
         r.lights.emplace();
         r.skyName = "neutral";
       }},
  };
  for (const Case& one : cases) {
    DrawRequest request = request_;
    request.shading = shadingNamed(one.shading);
    one.set(request);
    std::vector<std::string> arguments = {"--shading", one.shading};
    arguments.insert(arguments.end(), one.arguments.begin(), one.arguments.end());
    expectSame(arguments, request);
  }
}

TEST_F(LibraryPicture, MissingBake_IsMadeSaidAndGivenBack) {
  request_.shading = Shading::Sh;
  const LoadedScene shapes = scene();
  const Drawing first = draw(shapes, request_, {.device = &sharedDevice()});
  EXPECT_THAT(first.notes, Contains(HasSubstr("carries no bake")));
  ASSERT_NE(first.bake, nullptr);
  const Drawing second = draw(shapes, request_, {.bake = first.bake.get(), .device = &sharedDevice()});
  EXPECT_THAT(second.notes, Not(Contains(HasSubstr("carries no bake"))));
  EXPECT_TRUE(second.picture.pixels == first.picture.pixels);
}

TEST_F(LibraryPicture, Layers_AddUpToThePicture) {
  request_.shading = Shading::Phong;
  request_.layers = true;
  const Drawing drawing = draw(scene(), request_);
  std::vector<double> sum(drawing.picture.pixels.size(), 0.0);
  for (const PictureChannel& channel : drawing.layers)
    for (std::size_t i = 0; channel.name.ends_with(".G") && i < sum.size(); ++i) sum[i] += channel.values[i];
  ASSERT_THAT(drawing.layers, Not(IsEmpty()));
  for (std::size_t i = 0; i < sum.size(); ++i)
    EXPECT_NEAR(sum[i], drawing.picture.pixels[i].y, 1e-3 * (1.0 + drawing.picture.pixels[i].y));
  request_.layers = false;
  EXPECT_THAT(draw(scene(), request_).layers, IsEmpty());
}

TEST_F(LibraryPicture, GivenCamera_IsThatOfItsIndex) {
  const LoadedScene shapes = scene();
  ASSERT_FALSE(shapes.scene.cameras.empty());
  request_.shading = Shading::Phong;
  request_.cameraIndex = 0;
  const Drawing indexed = draw(shapes, request_);
  request_.cameraIndex.reset();
  request_.camera = shapes.scene.cameras[0];
  EXPECT_TRUE(draw(shapes, request_).picture.pixels == indexed.picture.pixels);
  request_.camera->world[3].y += 0.5;
  EXPECT_FALSE(draw(shapes, request_).picture.pixels == indexed.picture.pixels);
}

TEST_F(LibraryPicture, BadRequests_AreRefused) {
  const auto refused = [&](const std::function<void(DrawRequest&)>& spoil, const char* part) {
    DrawRequest request = request_;
    try {
      spoil(request);
      draw(scene(), request);
      ADD_FAILURE() << "nothing was refused: " << part;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr(part));
    }
  };
  refused([](DrawRequest& r) { r.height = 0; }, "DrawRequest::height");
  refused([](DrawRequest& r) { r.width = DrawRequest::maxSize + 1; }, "DrawRequest::width");
  refused([](DrawRequest& r) { r.options.occluders.shading.effects.waves = 11.0; }, "OccluderEffects::waves");
  refused([](DrawRequest& r) { r.full.gatherRays = 100; }, "power of two");
  refused([](DrawRequest& r) { r.instant.paths = 0; }, "InstantOptions::paths");
  refused([](DrawRequest& r) { r.encoding = "none"; }, "DrawRequest::encoding");
  refused([](DrawRequest& r) { r.shading = shadingNamed("glosy"); }, "did you mean glossy");
}

/// A row of each table that drawOptions() is made of.
TEST_F(LibraryPicture, NamedOptions_SetTheirMembers) {
  const auto set = [&](std::string_view name, double value) {
    for (const DrawOption& option : drawOptions())
      if (option.info.name == name) return option.set(request_, value);
    ADD_FAILURE() << "no option is called " << name;
  };
  request_.full.rasterised = true;
  set("wave-length", 0.5);
  set("horizon-softness", 5.0);
  set("lobe", 1.0);
  set("gather-rays", 64.0);
  set("virtual-lights", 16.0);
  set("caustics", 5000.0);
  set("object-shadow", 2.0);
  EXPECT_EQ(request_.options.occluders.waveLength, 0.5);
  EXPECT_EQ(request_.options.horizonSoftness, glm::radians(5.0));
  EXPECT_EQ(request_.lobe, Lobe::Phong);
  EXPECT_EQ(request_.full.gatherRays, 64u);
  EXPECT_TRUE(request_.full.rasterised);
  EXPECT_EQ(request_.instant.paths, 16u);
  EXPECT_EQ(request_.causticPhotons, 5000u);
  EXPECT_EQ(request_.objects.shadows, ObjectShadows::Neighbourhood);
}

TEST_F(LibraryPicture, Progress_StopsIt) {
  struct Stop final : Progress {
    bool stopRequested() const override { return true; }
  } stop;
  EXPECT_THROW(draw(scene(), request_, {.progress = &stop}), Interrupted);
}

}  // namespace
}  // namespace prelight::test
