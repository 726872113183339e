// Occlusion by elements of the scene's surface, compared with closed forms and with newly made scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "prelight/load.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/quad_scene.h"
#include "viewer/techniques/screen/disks/disk_tree.h"

namespace prelight {
namespace {

using namespace test;
using viewer::DiskTree;
using viewer::OcclusionMethod;
using viewer::Shading;

using std::numbers::pi;

/// Share of the sky that a square hides from a small parallel surface below its centre: the form factor of
/// four rectangles with a corner there. Side and height have the same unit.
double formFactorOfSquare(double half, double height) {
  const double a = half / height, root = std::sqrt(1.0 + a * a);
  return 4.0 / pi * a / root * std::atan(a / root);
}

struct Card {
  double half = 0.3, height = 0.5;
  bool facesFloor = true, twoSided = false;
};

/// Cards above the middle of a floor z = 0, which the camera sees from below the cards.
QuadScene cardsOverFloor(const std::vector<Card>& cards) {
  QuadScene scene;
  scene.add(lambertian(glm::vec3(1)), 1.0f);
  for (const Card& card : cards) {
    Material white = lambertian(glm::vec3(1));
    white.doubleSided = card.twoSided;
    glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, card.height));
    if (card.facesFloor) place = glm::rotate(place, pi, glm::dvec3(1, 0, 0));
    scene.add(white, static_cast<float>(card.half), place);
  }
  scene.setSky(constantEnvironment(glm::vec3(1)));
  scene.lookFrom({0.02, -0.2, 0.1}, {0, 0, 0});
  scene.compile();
  return scene;
}

viewer::RenderOptions diskOptions(int passes = 1, double radius = 50.0, double element = 0.05) {
  viewer::RenderOptions options = square(Shading::Screen, 9);
  options.samplesPerAxis = 1;
  options.screenOcclusion.method = OcclusionMethod::Disks;
  options.screenOcclusion.radius = radius;
  options.screenOcclusion.elementSize = element;
  options.screenOcclusion.passes = passes;
  options.screenOcclusion.filtered = false;
  return options;
}

double hidden(const QuadScene& scene, const viewer::RenderOptions& options) {
  return 1.0 - pixelAt(scene.render(options)).r;
}

void expectSquares(double opening, double tolerance) {
  for (const auto& [half, height] : {std::pair(0.3, 0.5), {0.3, 0.15}, {1.0, 2.0}, {0.2, 3.0}})
    for (const double element : {0.05, 0.5, 10.0}) {
      viewer::RenderOptions options = diskOptions(1, 50.0, element);
      options.screenOcclusion.opening = opening;
      EXPECT_NEAR(hidden(cardsOverFloor({{half, height}}), options), formFactorOfSquare(half, height),
                  tolerance)
          << half << " " << height << " " << element;
    }
}

TEST(DiskOcclusion, SquareAbove_HidesItsFormFactor) {
  expectSquares(0.4, 0.025);
  expectSquares(0.05, 0.008);
}

TEST(DiskOcclusion, BeyondTheRadius_HidesNothing) {
  EXPECT_NEAR(hidden(cardsOverFloor({{0.3, 0.5}}), diskOptions(1, 0.2)), 0.0, 1e-5);
}

TEST(DiskOcclusion, BackOfOneSidedSurface_HidesNothing_OfTwoSidedAsMuchAsItsFront) {
  EXPECT_NEAR(hidden(cardsOverFloor({{0.3, 0.5, false}}), diskOptions()), 0.0, 1e-5);
  for (const bool facesFloor : {true, false})
    EXPECT_NEAR(hidden(cardsOverFloor({{0.3, 0.5, facesFloor, true}}), diskOptions()),
                formFactorOfSquare(0.3, 0.5), 0.01);
}

TEST(DiskOcclusion, CardBehindAnother_CountsByHowOpenItIsFromTheSecondPassOn) {
  const QuadScene scene = cardsOverFloor({{0.3, 0.25}, {0.3, 0.27}});
  const double near = formFactorOfSquare(0.3, 0.25), far = formFactorOfSquare(0.3, 0.27);
  EXPECT_NEAR(hidden(scene, diskOptions(1)), std::min(near + far, 1.0), 0.02);
  EXPECT_NEAR(hidden(scene, diskOptions(2)), near, 0.15 * far);
}

TEST(DiskOcclusion, MovedVertices_OccludeFromWhereTheyAre) {
  QuadScene scene = cardsOverFloor({{0.3, 0.5}});
  const viewer::gl::EglContext context;
  const viewer::RenderInputs inputs = scene.inputs();
  const viewer::View view = viewer::makeView(inputs, diskOptions());
  viewer::Renderer renderer(inputs);
  const glm::vec3 before = pixelAt(viewer::renderView(renderer, view, 1));
  for (std::size_t v = 4; v < 8; ++v) scene.compiled.positions[v].z += 0.5f;
  renderer.sceneMoved();
  const Picture moved = viewer::renderView(renderer, view, 1);
  viewer::Renderer fresh(inputs);
  const Picture anew = viewer::renderView(fresh, view, 1);
  for (std::size_t i = 0; i < anew.pixels.size(); ++i)
    EXPECT_NEAR(moved.pixels[i].r, anew.pixels[i].r, 1e-3f);
  EXPECT_NEAR(pixelAt(moved).r, 1.0 - formFactorOfSquare(0.3, 1.0), 0.01);
  EXPECT_LT(before.r, pixelAt(moved).r - 0.1f);
}

TEST(DiskOcclusion, SceneWithoutOccluders_IsOpen) {
  Material pane = lambertian(glm::vec3(1));
  pane.alphaMode = AlphaMode::Blend;
  pane.baseColor.a = 0.5f;
  QuadScene scene;
  scene.add(pane);
  scene.lookFrom({0, 0, 2}, {0, 0, 0});
  scene.setSky(constantEnvironment(glm::vec3(1)));
  scene.compile();
  EXPECT_EQ(DiskTree(scene.compiled, 1.0).nodeCount(), 0u);
  EXPECT_NEAR(hidden(scene, diskOptions()), 0.0, 1e-4);
}

/// Sums over the group of all elements: normals times areas, and area.
glm::vec4 wholeOf(const DiskTree& tree) { return tree.texels()[1]; }

TEST(DiskTree, GroupOfAll_HasTheAreasAndNormalsOfTheTriangles) {
  Warnings warnings;
  const CompiledScene scene = compileScene(loadBuiltin("cornell").scene, warnings);
  double area = 0.0;
  glm::dvec3 sum(0.0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    if (scene.materials[scene.triangleMaterials[t]].doubleSided) continue;
    area += 0.5 * glm::length(geometricNormal(scene, t));
    sum += 0.5 * geometricNormal(scene, t);
  }
  for (const double size : {100.0, 0.1}) {
    const DiskTree tree(scene, size);
    EXPECT_GE(tree.elementCount(), scene.triangleCount());
    EXPECT_NEAR(wholeOf(tree).w, area, 1e-3 * area) << size;
    EXPECT_NEAR(glm::distance(glm::dvec3(wholeOf(tree)), sum), 0.0, 1e-3 * area) << size;
  }
}

TEST(DiskTree, TooManyPieces_AreLarger) {
  const QuadScene scene = cardsOverFloor({{}});
  EXPECT_LE(DiskTree(scene.compiled, 1e-4).elementCount(), DiskTree::mostPieces);
}

}  // namespace
}  // namespace prelight
