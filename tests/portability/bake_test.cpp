// A small bake with all projections gives nearly the same values on every device.
#include <gtest/gtest.h>

#include <cmath>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "portability/devices.h"
#include "stress/closed_meshes.h"

namespace prelight {
namespace {

Bake bakeOn(const Device& device, const std::string& name) {
  BakeRequest request;
  request.ao = true;
  request.sh.order = 4;
  request.bounces = 2;
  request.effort.rays = 256;
  Warnings warnings;
  const Scene scene = test::builtinScene(name);
  const CompiledScene compiled = compileScene(scene, warnings);
  Progress progress;
  BakeReport report;
  return bakeScene(compiled, request, makePlan(scene, compiled, request), device, progress, report);
}

double rmsDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (double(a[i]) - b[i]) * (double(a[i]) - b[i]);
  return std::sqrt(sum / double(a.size()));
}

// All devices cast the same rays from the same receivers. They differ by the rounding of sums and sines, and
// where rounding sends a ray past the other side of an edge. One of 256 rays moves a vertex's AO by 0.004.
TEST(PortableBake, BuiltinScenes_ValuesAgree) {
  PRELIGHT_NEEDS_TWO_DEVICES();
  for (const std::string name : {"cornell", "shapes"}) {
    const Bake first = bakeOn(test::allDevices()[0], name);
    for (std::size_t d = 1; d < test::allDevices().size(); ++d) {
      SCOPED_TRACE(name + " on " + test::nameOf(test::allDevices()[d]));
      const Bake other = bakeOn(test::allDevices()[d], name);
      ASSERT_EQ(other.ao.size(), first.ao.size());
      ASSERT_EQ(other.sh->coefficients.size(), first.sh->coefficients.size());
      EXPECT_LT(rmsDifference(first.ao, other.ao), 1e-4);
      EXPECT_LT(rmsDifference(first.sh->coefficients, other.sh->coefficients), 1e-4);
      double angle = 0.0;
      for (std::size_t i = 0; i < first.bentNormals.size(); ++i)
        angle += glm::length(glm::dvec3(first.bentNormals[i]) - glm::dvec3(other.bentNormals[i]));
      EXPECT_LT(angle / double(first.bentNormals.size()), 1e-3);
      RecordProperty("ao_" + name, std::to_string(1e6 * rmsDifference(first.ao, other.ao)) + "e-6");
      RecordProperty(
          "sh_" + name,
          std::to_string(1e6 * rmsDifference(first.sh->coefficients, other.sh->coefficients)) + "e-6");
    }
  }
}

}  // namespace
}  // namespace prelight
