// Transfer that changes while a window is open, and probes that are hidden.
#include <gtest/gtest.h>

#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/open_transfers.h"
#include "viewer/picture_checks.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

/// Two quads side by side; the second has its own material.
QuadScene twoQuads() {
  QuadScene quads;
  quads.add(lambertian(glm::vec3(0.8f)), 0.5f, glm::translate(glm::dmat4(1.0), glm::dvec3(-0.6, 0, 0)));
  quads.add(lambertian(glm::vec3(0.8f)), 0.5f, glm::translate(glm::dmat4(1.0), glm::dvec3(0.6, 0, 0)));
  quads.lookFrom({0, 0, 3}, {0, 0, 0});
  quads.setSky(constantEnvironment(glm::vec3(1)));
  quads.compile();
  quads.bakeOpen(3, 3);
  quads.bake.lightGroups = LightGroupTransfer{
      {{"lamp", {1, 1, 1}}, {"other", {1, 1, 1}}}, 3, 0, std::vector<float>(8 * 3 * 2, 0.5f)};
  return quads;
}

/// Halves the transfer of the second quad's vertices.
void dim(Bake& bake) {
  for (std::size_t i = 4 * 3 * 9; i < 8 * 3 * 9; ++i) bake.sh->coefficients[i] *= 0.5f;
  for (std::size_t i = 4 * 3 * 2; i < 8 * 3 * 2; ++i) bake.lightGroups->coefficients[i] *= 0.25f;
}

TEST(ChangedTransfer, OfSomeVertices_ShowsWhatABakeWithItShows) {
  for (const Shading shading : {Shading::Sh, Shading::Lights}) {
    QuadScene quads = twoQuads();
    const viewer::gl::EglContext context;
    const viewer::RenderInputs inputs = quads.inputs();
    viewer::Renderer renderer(inputs);
    const viewer::View view = viewer::makeView(inputs, square(shading));
    const Picture before = viewer::renderView(renderer, view, 1);
    dim(quads.bake);
    renderer.transferChanged(std::vector<VertexRange>{{4, 4, 2, 2}});
    const Picture after = viewer::renderView(renderer, view, 1);
    EXPECT_EQ(pixelAt(after, 0.3, 0.5), pixelAt(before, 0.3, 0.5));
    EXPECT_LT(pixelAt(after, 0.7, 0.5).x, 0.6f * pixelAt(before, 0.7, 0.5).x);
    viewer::Renderer fresh(inputs);
    EXPECT_LT(largestDifference(after, viewer::renderView(fresh, view, 1)), 1e-6);
  }
}

TEST(Probes, Hidden_LeaveTheRest) {
  QuadScene quads = twoQuads();
  viewer::RenderInputs inputs = quads.inputs();
  inputs.probes = viewer::DrawnProbes{1, 1};
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs);
  viewer::View view = viewer::makeView(inputs, square(Shading::Lights));
  const Picture shown = viewer::renderView(renderer, view, 1);
  view.hidesProbes = true;
  const Picture hidden = viewer::renderView(renderer, view, 1);
  EXPECT_EQ(pixelAt(hidden, 0.3, 0.5), pixelAt(shown, 0.3, 0.5));
  EXPECT_NEAR(pixelAt(shown, 0.7, 0.5).x, 0.8f, 1e-5f);
  EXPECT_NEAR(pixelAt(hidden, 0.7, 0.5).x, 1.0f, 1e-5f) << "the sky behind";
}

}  // namespace
}  // namespace prelight
