#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "prelight/prelight.h"
#include "support/devices.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

/// Message of the error that a call throws, or empty if it throws none.
template <typename Call>
std::string complaintOf(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

const LoadedScene& cornell() {
  static const LoadedScene scene = loadBuiltin("cornell");
  return scene;
}

/// Asks to stop after a number of reports.
class StoppingProgress final : public Progress {
 public:
  explicit StoppingProgress(int reports) : left_(reports) {}
  void report(std::string_view, double) override { --left_; }
  bool stopRequested() const override { return left_ < 0; }

 private:
  std::atomic<int> left_;
};

/// Remembers the progress of the cast at its first report.
class FirstReport final : public Progress {
 public:
  void report(std::string_view stage, double fraction) override {
    if (stage == "cast" && fraction_ < 0.0) fraction_ = fraction;
  }
  double fraction() const { return fraction_; }

 private:
  std::atomic<double> fraction_ = -1.0;
};

/// A temporary folder for each test.
class LibraryFiles : public ::testing::Test {
 protected:
  std::filesystem::path path(const char* name) const { return folder_ / name; }

 private:
  test::TemporaryFolder folder_;
};

TEST(Load, BytesThatAreNoGltf_AreRefusedByName) {
  EXPECT_THROW(load(bytesOf("")), InputError);
  EXPECT_THROW(load(bytesOf("{")), InputError);
  EXPECT_THAT(complaintOf([] { load(bytesOf(R"({"asset": {"version": "3.0"}})")); }), HasSubstr("memory"));
}

TEST(Load, FilesOutsideOfTheFolder_NeedLeave) {
  const std::string text =
      R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "../../../../etc/hostname"}]})";
  const std::string complaint =
      complaintOf([&] { load(bytesOf(text), std::filesystem::temp_directory_path()); });
  EXPECT_THAT(complaint, HasSubstr("LoadOptions::allowOutside"));
}

TEST(Load, UnknownBuiltinScene_IsAUsageErrorWithTheNames) {
  EXPECT_THAT(complaintOf([] { loadBuiltin("cornel"); }), HasSubstr("cornell"));
  EXPECT_GE(builtinScenes().size(), 5u);
}

TEST(BakeCall, NothingAskedFor_IsAUsageError) {
  EXPECT_THROW(bake(cornell(), {}, {.device = &test::sharedDevice()}), UsageError);
}

TEST(BakeCall, SceneWithoutTriangles_IsAnInputError) {
  const LoadedScene empty = load(bytesOf(R"({"asset": {"version": "2.0"}})"));
  EXPECT_THROW(bake(empty, {.ao = true}, {.device = &test::sharedDevice()}), InputError);
  EXPECT_THROW(render(empty, {.device = &test::sharedDevice()}), InputError);
  EXPECT_THROW(photons(empty, {.device = &test::sharedDevice()}), InputError);
}

TEST(BakeCall, PlanOfARequest_SaysWhatRuns) {
  const Plan planned = plan(cornell(), {.ao = true});
  EXPECT_TRUE(planned.runs(Pass::AmbientOcclusion));
  EXPECT_FALSE(planned.runs(Pass::ShTransfer));
}

/// Values are the same with and without an interruption, and the state file is removed in the end.
TEST_F(LibraryFiles, InterruptedBake_GoesOnFromItsCheckpoint) {
  const BakeRequest request{
      .ao = true, .sh = {.order = 2}, .bounces = 1, .effort = {.rays = 1024}, .seed = 3};
  const Device& device = test::sharedDevice();
  FirstReport fromStart, fromState;
  const BakeResult whole = bake(cornell(), request, {.device = &device, .progress = &fromStart});

  const std::filesystem::path state = path("bake.state");
  StoppingProgress stopping(3);
  EXPECT_THROW(bake(cornell(), request, {.device = &device, .progress = &stopping, .checkpoint = state}),
               Interrupted);
  ASSERT_TRUE(std::filesystem::exists(state));
  BakeRequest other = request;
  other.seed = 4;
  EXPECT_THAT(complaintOf([&] { bake(cornell(), other, {.device = &device, .checkpoint = state}); }),
              HasSubstr("another seed"));

  const BakeResult resumed =
      bake(cornell(), request, {.device = &device, .progress = &fromState, .checkpoint = state});
  EXPECT_EQ(resumed.bake.ao, whole.bake.ao);
  EXPECT_EQ(resumed.bake.sh->coefficients, whole.bake.sh->coefficients);
  EXPECT_GT(fromState.fraction(), fromStart.fraction()) << "nothing was taken from the checkpoint";
  EXPECT_FALSE(std::filesystem::exists(state));
}

TEST_F(LibraryFiles, LightMapOfABake_IsSavedBesideItsFile) {
  const Device& device = test::sharedDevice();
  const BakeRequest request{.lightMap = {.wanted = true, .texelSize = 0.25, .photons = 20'000},
                            .effort = {.rays = 64}};
  const BakeResult result = bake(cornell(), request, {.device = &device});
  ASSERT_TRUE(result.bake.lightMap);
  save(path("room.glb"), cornell(), result.bake);
  EXPECT_TRUE(std::filesystem::exists(path("room.lightmap.exr")));
  const std::optional<Bake> read = carriedBake(load(path("room.glb")));
  ASSERT_TRUE(read && read->lightMap);
  EXPECT_EQ(read->lightMap->values, result.bake.lightMap->values);
}

TEST_F(LibraryFiles, OtherExtensionThanGlb_IsRefusedBySave) {
  EXPECT_THROW(save(path("room.gltf"), cornell(), {}), UsageError);
  EXPECT_FALSE(carriedBake(cornell()).has_value());
}

TEST(Render, OptionsOutOfTheirRange_AreNamed) {
  const Device* device = &test::sharedDevice();
  EXPECT_THAT(complaintOf([&] { render(cornell(), {.height = 0, .device = device}); }),
              HasSubstr("RenderOptions::height: got 0, expected a whole number from 1 to 16384"));
  EXPECT_THAT(complaintOf([&] { render(cornell(), {.samples = 0, .device = device}); }),
              HasSubstr("RenderOptions::samples"));
  EXPECT_THAT(complaintOf([&] { render(cornell(), {.depth = 2000, .device = device}); }),
              HasSubstr("RenderOptions::depth"));
}

double meanLuminance(const Picture& picture) {
  double sum = 0.0;
  for (const glm::vec3& pixel : picture.pixels) sum += (pixel.x + pixel.y + pixel.z) / 3.0;
  return sum / static_cast<double>(picture.pixels.size());
}

/// Two estimates of one integral that share neither photons nor paths; noise and bias of both are within 5 %.
TEST(Render, GlobalIllumination_ShowsTheLightThatPathsFind) {
  const Device* device = &test::sharedDevice();
  const Picture paths = render(cornell(), {.width = 48, .height = 48, .samples = 256, .device = device});
  const Picture cached = render(cornell(), {.method = RenderMethod::GlobalIllumination,
                                            .width = 48,
                                            .height = 48,
                                            .samples = 16,
                                            .device = device});
  ASSERT_EQ(paths.pixels.size(), 48u * 48u);
  ASSERT_EQ(cached.pixels.size(), paths.pixels.size());
  EXPECT_NEAR(meanLuminance(cached) / meanLuminance(paths), 1.0, 0.05);
}

TEST(Reference, GoalOfAnError_IsReachedAndTold) {
  const RenderOptions options{.width = 24, .height = 24, .device = &test::sharedDevice()};
  const ReferencePicture rough = drawReference(cornell(), options, {.error = 0.5});
  const ReferencePicture fine = drawReference(cornell(), options, {.error = 0.03});
  EXPECT_LT(fine.error, 0.03);
  EXPECT_GT(fine.samples, rough.samples);
  EXPECT_EQ(fine.variance.size(), fine.picture.pixels.size());
  EXPECT_THROW(drawReference(cornell(), {.method = RenderMethod::GlobalIllumination}), UsageError);
  EXPECT_THROW(drawReference(cornell(), options, {.error = 0.0}), UsageError);
}

TEST(Errors, PartsOfAMessage_MakeTheWhole) {
  const Error error(ExitCode::BadInput, "room.glb", "got nothing", "give something");
  EXPECT_EQ(error.where() + ": " + error.problem() + " (" + error.fix() + ")", std::string(error.what()));
}

TEST(Trace, RayWithoutDirection_IsNamed) {
  const std::vector<Ray> rays(2);
  std::vector<Ray> bad = rays;
  bad[1].direction = glm::dvec3(0.0);
  EXPECT_THAT(complaintOf([&] { trace(cornell(), bad, {.device = &test::sharedDevice()}); }),
              HasSubstr("Ray 1"));
  EXPECT_TRUE(trace(cornell(), {}, {.device = &test::sharedDevice()}).empty());
}

TEST(Trace, FarthestDistance_EndsARay) {
  const Camera& camera = cornell().scene.cameras.front();
  const glm::dvec3 eye(camera.world[3]), forward = -glm::dvec3(camera.world[2]);
  const Device* device = &test::sharedDevice();
  const auto first = trace(cornell(), std::vector<Ray>{{eye, 3.0 * forward}}, {.device = device});
  ASSERT_TRUE(first.front().has_value());
  const double distance = first.front()->distance;
  EXPECT_NEAR(glm::length(first.front()->position - eye), distance, 1e-6 * distance);
  const auto both =
      trace(cornell(), std::vector<Ray>{{eye, forward, 0.99 * distance}, {eye, forward, 1.01 * distance}},
            {.device = device});
  EXPECT_FALSE(both[0].has_value());
  EXPECT_TRUE(both[1].has_value());
}

/// All power that lamps emit is absorbed or escapes.
TEST(Photons, PowerThatIsEmitted_IsAbsorbedOrEscapes) {
  const PhotonResult sent = photons(cornell(), {.photons = 20'000, .device = &test::sharedDevice()});
  EXPECT_GT(sent.emitted.x, 0.0);
  EXPECT_FALSE(sent.photons.empty());
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(sent.absorbed[c] + sent.escaped[c], sent.emitted[c], 1e-4 * sent.emitted[c]);
  EXPECT_THROW(photons(cornell(), {.photons = 0}), UsageError);
}

TEST(Devices, SelectorThatFitsNone_IsNamedAsAField) {
  EXPECT_THAT(complaintOf([] { Device::open({.selector = "abacus"}); }),
              HasSubstr("DeviceOptions::selector abacus"));
  EXPECT_THAT(complaintOf([] { Device::open({.selector = "abacus"}); }), Not(HasSubstr("--")));
}

}  // namespace
}  // namespace prelight
