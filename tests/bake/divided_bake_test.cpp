// Bakes that several processes divide among them hold what one process bakes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "support/bakes_of_everything.h"
#include "support/devices.h"
#include "support/divided.h"

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

 private:
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

TEST(DividedBakeStages, OfACast_EndWithPassesThatAreLookedBackOn) {
  test::DividedWork divided(2);
  (void)SmallBake(test::occluderRequest()).by(divided);
  EXPECT_THAT(divided.stages(),
              ::testing::ElementsAre("cast from fronts, pass 1", "cast from fronts, pass 2",
                                     "cast from fronts, passes 3 to 4", "cast from fronts, passes 5 to 8"));
}

}  // namespace
}  // namespace prelight
