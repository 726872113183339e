#include <gtest/gtest.h>

#include <cmath>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "support/devices.h"
#include "support/instanced_scene.h"

namespace prelight {
namespace {

struct InstancesBake {
  Bake bake;
  BakeReport report;
};

/// Overrides what the plan would choose for so few triangles.
InstancesBake bakeWith(const Scene& source, const CompiledScene& scene, const BakeRequest& request,
                       bool instances) {
  Plan plan = makePlan(source, scene, request);
  for (PlannedPass& pass : plan.passes)
    if (pass.name == Pass::Instances.name) pass.runs = instances;
  InstancesBake result;
  Progress progress;
  result.bake = bakeScene(scene, request, plan, test::sharedDevice(), progress, result.report);
  return result;
}

/// Root mean square difference.
double apart(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double(a[i]) - double(b[i]), 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(BakeInstances, ResultsAreThoseOfOneTree) {
  Scene source = test::strewnScene(24, 3.0, 4);
  Material red;
  red.baseColor = {0.8f, 0.3f, 0.2f, 1.0f};
  red.metallic = 0.0f;
  Material grey;
  grey.baseColor = {0.5f, 0.5f, 0.5f, 1.0f};
  grey.metallic = 0.0f;
  source.materials = {red, grey};
  source.meshes[0].primitives[0].material = 0;
  source.meshes[1].primitives[0].material = 1;
  const CompiledScene scene = test::compiled(source);
  BakeRequest request;
  request.ao = true;
  request.sh.order = 2;
  request.bounces = 1;
  request.effort.rays = 64;
  const InstancesBake shared = bakeWith(source, scene, request, true),
                      flat = bakeWith(source, scene, request, false);
  EXPECT_LT(3 * shared.report.bytesBvh, flat.report.bytesBvh);
  // A few rays in a hundred thousand pass an edge on the other side.
  EXPECT_LT(apart(shared.bake.ao, flat.bake.ao), 1e-3);
  EXPECT_LT(apart(shared.bake.sh->coefficients, flat.bake.sh->coefficients), 1e-3);
  EXPECT_EQ(bakeWith(source, scene, request, true).bake.ao, shared.bake.ao);
}

}  // namespace
}  // namespace prelight
