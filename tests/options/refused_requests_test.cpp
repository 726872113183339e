#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <string>

#include "options/bad_numbers.h"
#include "prelight/prelight.h"

namespace prelight {
namespace {

/// Hides all devices, so that a request that opens one fails for that reason and not because of a number.
class RefusedRequests : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("OCL_ICD_VENDORS", "/nonexistent", 1);
    setenv("OCL_ICD_FILENAMES", "", 1);
  }

  /// Expects a UsageError about `field`.
  static void expectRefusal(const std::string& field, const std::function<void()>& call) {
    try {
      call();
      ADD_FAILURE() << field << ": taken";
    } catch (const UsageError& error) {
      EXPECT_EQ(error.where(), field) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << field << ": " << error.what();
    }
  }

  const LoadedScene scene_ = loadBuiltin("shapes");
};

BakeRequest soundRequest() {
  BakeRequest request;
  request.ao = request.lightMap.wanted = true;
  request.sh.order = 2;
  return request;
}

TEST_F(RefusedRequests, BakeAndPlan_RefuseBadNumbersBeforeADeviceIsOpened) {
  for (const auto& bad : test::badNumbersOf(soundRequest())) {
    expectRefusal(bad.row->field, [&] { plan(scene_, bad.options); });
    expectRefusal(bad.row->field, [&] { bake(scene_, bad.options); });
  }
}

TEST_F(RefusedRequests, Keys_OutOfRange_AreRefused) {
  BakeResult baked;
  baked.bake.sh.emplace();
  for (const auto& bad : test::badNumbersOf(AnimationKeys()))
    expectRefusal(bad.row->field, [&] { bakeKeys(scene_, soundRequest(), bad.options, baked); });
}

TEST_F(RefusedRequests, Pictures_WithBadNumbers_AreRefused) {
  for (const auto& bad : test::badNumbersOf(RenderOptions())) {
    expectRefusal(bad.row->field, [&] { render(scene_, bad.options); });
    expectRefusal(bad.row->field, [&] { drawReference(scene_, bad.options); });
  }
  for (const auto& bad : test::badNumbersOf(ReferenceGoal()))
    expectRefusal(bad.row->field, [&] { drawReference(scene_, {}, bad.options); });
  expectRefusal("RenderOptions::samples",
                [&] { render(scene_, {.method = RenderMethod::GlobalIllumination, .samples = 65}); });
}

TEST_F(RefusedRequests, PhotonsAndFiles_WithBadNumbers_AreRefused) {
  for (const auto& bad : test::badNumbersOf(PhotonOptions()))
    expectRefusal(bad.row->field, [&] { photons(scene_, bad.options); });
  for (const auto& bad : test::badNumbersOf(LoadOptions()))
    expectRefusal(bad.row->field, [&] { load("nowhere.glb", bad.options); });
}

TEST_F(RefusedRequests, NumbersThatExcludeEachOther_AreRefused) {
  const auto refuses = [&](const char* field, const std::function<void(BakeRequest&)>& change) {
    BakeRequest request = soundRequest();
    change(request);
    expectRefusal(field, [&] { bake(scene_, request); });
  };
  refuses("Effort::error", [](BakeRequest& r) { r.effort = {.error = 0.1, .seconds = 1.0}; });
  refuses("OcclusionLimits::nearest", [](BakeRequest& r) { r.limits = {.nearest = 2.0, .farthest = 2.0}; });
  refuses("ChartTransferRequest::relief", [](BakeRequest& r) { r.chartTransfer.relief = true; });
  refuses("VolumeRequest::size", [](BakeRequest& r) {
    r.sh.order = 0;
    r.volume.size = 4;
  });
  refuses("LightMapRequest::texelSize", [](BakeRequest& r) {
    r.lightMap.wanted = false;
    r.lightMap.texelSize = 0.5;
  });
  refuses("EncodedLightRequest::encodings", [](BakeRequest& r) {
    r.lightMap.wanted = false;
    r.encodedLight.encodings = {"ambient-cube"};
  });
}

/// The numbers are within all ranges, but need more memory than any machine has.
TEST_F(RefusedRequests, BakeThatNeedsMoreThanThereIs_SaysSoBeforeADeviceIsOpened) {
  BakeRequest request;
  request.sh.order = BakeRequest::maxShOrder;
  request.ao = true;
  request.maxMemory = 64u << 20;
  try {
    bake(scene_, request);
    FAIL() << "baked";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::OutOfMemory) << error.what();
    EXPECT_EQ(error.where(), "BakeRequest::maxMemory");
    EXPECT_NE(error.problem().find("64 MB are allowed"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace prelight
