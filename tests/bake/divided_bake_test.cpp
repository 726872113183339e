// Bakes that several processes divide among them hold what one process bakes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "base/resumable_run.h"
#include "base/work_parts.h"
#include "prelight/error.h"
#include "support/bakes_of_everything.h"
#include "support/devices.h"
#include "support/divided.h"
#include "support/gltf_files.h"
#include "support/spoiled.h"

namespace prelight {
namespace {

/// A small bake, by one process or by several.
class SmallBake {
 public:
  explicit SmallBake(BakeRequest request) : request_(std::move(request)) {}

  Bake whole() const {
    Progress progress;
    return bake(progress);
  }
  Bake by(test::DividedWork& divided) const {
    return divided.run([&](Progress& progress) { return bake(progress); });
  }

  /// Does a whole stage as one slice.
  void slice(const std::filesystem::path& part, const std::filesystem::path& state) const {
    WorkSlice share(part, "test", {}, {1, 1}, {});
    ResumableRun run(state, "test");
    Progress outer;
    EXPECT_THROW((void)bake(run.begin({}, outer, StateUse::Read, &share)), StageEnd);
  }

  /// Returns whether a stage is left. Values must be finite.
  bool merge(const std::filesystem::path& part, const std::filesystem::path& state) const {
    GivenParts given({part}, "test", {}, false);
    ResumableRun run(state, "test");
    Progress outer;
    try {
      expectFinite(bake(run.begin({}, outer, StateUse::Continue, &given)));
      return false;
    } catch (const StageEnd&) {
      return true;
    }
  }

 private:
  static void expectFinite(const Bake& result) {
    const auto isFinite = [](float value) { return std::isfinite(value); };
    EXPECT_TRUE(std::all_of(result.ao.begin(), result.ao.end(), isFinite));
    if (result.sh) {
      EXPECT_TRUE(std::all_of(result.sh->coefficients.begin(), result.sh->coefficients.end(), isFinite));
    }
    if (result.lightMap) {
      EXPECT_TRUE(std::all_of(result.lightMap->values.begin(), result.lightMap->values.end(), isFinite));
    }
  }

  Bake bake(Progress& progress) const {
    BakeReport report;
    return bakeScene(scene_, request_, plan_, test::sharedDevice(), progress, report, nullptr, &source_);
  }

  const CompiledScene scene_ = test::groundAndSphere();
  const Scene source_;
  const BakeRequest request_;
  const Plan plan_ = makePlan(source_, scene_, request_);
};

struct Case {
  const char* name;
  BakeRequest request;

  friend void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }
};

class DividedBake : public ::testing::TestWithParam<Case> {
 protected:
  const SmallBake bake_{GetParam().request};
};

TEST_P(DividedBake, InTwoSlices_IsThatOfOneProcess) {
  test::DividedWork divided(2);
  test::expectSame(bake_.by(divided), bake_.whole());
  EXPECT_EQ(divided.here(), 0u);
}

TEST_P(DividedBake, SomeOfSevenSlicesLost_IsThatOfOneProcess) {
  test::DividedWork divided(7, 0.4);
  test::expectSame(bake_.by(divided), bake_.whole());
  EXPECT_GT(divided.here(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Techniques, DividedBake,
                         ::testing::Values(Case{"Vertices", test::vertexRequest()},
                                           Case{"Occluders", test::occluderRequest()},
                                           Case{"Error", test::errorRequest()},
                                           Case{"Radiosity", test::radiosityRequest()},
                                           Case{"LightMap", test::lightMapRequest()},
                                           Case{"TexelSizes", test::texelErrorRequest()}),
                         [](const auto& test) { return test.param.name; });

/// Copies a slice's file with one piece spoiled.
void copySpoiled(const std::filesystem::path& from, const std::filesystem::path& to, std::mt19937& random) {
  const StateLog part = StateLog::openAny(from, StateLog::Access::Read).value();
  const std::vector<std::string> names = part.names();
  StateLog copy(to, part.kind(), part.key());
  const std::string& chosen = names[random() % names.size()];
  for (const std::string& name : names) {
    std::vector<std::byte> bytes = part.read(name);
    if (name == chosen && bytes.size() > 1) test::spoil(bytes, random);
    copy.write(name, [&](const StateWriter::Sink& sink) { sink(bytes); });
  }
  copy.commit(0.0);
}

// Files of slices may come from anyone.
TEST_P(DividedBake, PiecesSpoiled_AreRefusedOrHarmless) {
  const test::TemporaryFolder folder;
  const std::filesystem::path state = folder / "a.state", part = folder / "1.part",
                              spoiled = folder / "spoiled.part", tried = folder / "tried.state";
  std::mt19937 random(11);
  int refused = 0;
  for (bool left = true; left;) {
    std::filesystem::remove(part);
    bake_.slice(part, state);
    for (int i = 0; i < 6; ++i) {
      std::filesystem::remove(tried);
      if (std::filesystem::exists(state)) std::filesystem::copy_file(state, tried);
      copySpoiled(part, spoiled, random);
      try {
        (void)bake_.merge(spoiled, tried);
      } catch (const InputError&) {
        ++refused;
      } catch (const UsageError&) {  // the title is spoiled: it is of no stage
      }
    }
    left = bake_.merge(part, state);
  }
  EXPECT_GT(refused, 2);
}

TEST(DividedBakeStages, OfACast_EndWithPassesThatAreLookedBackOn) {
  test::DividedWork divided(2);
  (void)SmallBake(test::occluderRequest()).by(divided);
  EXPECT_THAT(divided.stages(),
              ::testing::ElementsAre("cast from fronts, pass 1", "cast from fronts, pass 2",
                                     "cast from fronts, passes 3 to 4", "cast from fronts, passes 5 to 8"));
  BakeRequest request;
  request.ao = true;
  request.effort.rays = 64;
  test::DividedWork withoutOccluders(2);
  (void)SmallBake(request).by(withoutOccluders);
  EXPECT_THAT(withoutOccluders.stages(),
              ::testing::ElementsAre("cast from fronts, passes 1 to 2", "cast from fronts, passes 3 to 8"));
}

}  // namespace
}  // namespace prelight
