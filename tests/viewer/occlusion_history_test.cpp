// Occlusion averaged over several pictures: still scenes, a moving camera, a moving object.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "viewer/corner_scene.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"

namespace prelight {
namespace {

using namespace test;
using viewer::OcclusionMethod;
using viewer::ScreenOcclusionOptions;

/// Options with one slice per pixel, averaged over `frames` pictures.
ScreenOcclusionOptions coarse(int frames, OcclusionMethod method = OcclusionMethod::Gtao) {
  ScreenOcclusionOptions options = within(0.5, method);
  options.slices = 1;
  options.steps = 6;
  options.frames = frames;
  return options;
}

/// Options that the average approaches: as many steps and far more slices.
ScreenOcclusionOptions fine(OcclusionMethod method = OcclusionMethod::Gtao) {
  ScreenOcclusionOptions options = coarse(8, method);
  options.slices = 32;
  return options;
}

ScreenOcclusionOptions unfiltered(ScreenOcclusionOptions options) {
  options.filtered = false;
  return options;
}

double rms(const Picture& a, const Picture& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    sum += std::pow(double{a.pixels[i].r} - b.pixels[i].r, 2.0);
  return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

TEST(OcclusionHistory, StillPicture_NearsThatOfManySlices) {
  const QuadScene card = cardOverFloor();
  for (const OcclusionMethod method : {OcclusionMethod::Gtao, OcclusionMethod::Ssdo}) {
    const Picture many = card.render(screenOptions(48, unfiltered(fine(method))));
    double last = 1.0;
    for (const int frames : {1, 4, 16}) {
      const double error = rms(card.render(screenOptions(48, unfiltered(coarse(frames, method)))), many);
      EXPECT_LT(error, 0.6 * last) << frames;
      last = error;
    }
    EXPECT_LT(last, 0.012);
  }
}

/// A renderer that keeps its occlusion.
struct Window {
  explicit Window(const viewer::RenderInputs& inputs) : renderer(inputs) { renderer.reuseOcclusion(true); }
  Picture draw(const viewer::View& view) { return viewer::renderView(renderer, view, 1); }

  viewer::gl::EglContext context;
  viewer::Renderer renderer;
};

TEST(OcclusionHistory, PicturesOneAfterTheOther_AreOneOfAllOfThem) {
  const QuadScene card = cardOverFloor();
  const viewer::RenderOptions options = screenOptions(48, coarse(8));
  const Picture whole = card.render(options);
  Window window(card.inputs());
  const viewer::View view = viewer::makeView(card.inputs(), options);
  Picture last;
  for (int i = 0; i < 8; ++i) {
    last = window.draw(view);
    EXPECT_EQ(window.renderer.isBehind(), i < 7) << i;
  }
  for (std::size_t i = 0; i < whole.pixels.size(); ++i)
    EXPECT_NEAR(last.pixels[i].r, whole.pixels[i].r, 1e-4f);
}

TEST(OcclusionHistory, CameraThatMoves_KeepsWhatItHasSeen) {
  QuadScene card = cardOverFloor();
  const ScreenOcclusionOptions options = unfiltered(coarse(16));
  Window window(card.inputs());
  Picture last;
  for (int i = 0; i < 16; ++i) {
    card.scene.cameras.clear();
    card.lookFrom({0.2 + 0.011 * i, -2.0, 2.0}, {0.005 * i, 0, 0});
    last = window.draw(viewer::makeView(card.inputs(), screenOptions(48, options)));
  }
  const Picture many = card.render(screenOptions(48, unfiltered(fine())));
  const Picture single = card.render(screenOptions(48, unfiltered(coarse(1))));
  EXPECT_LT(rms(last, many), 0.5 * rms(single, many));
}

/// Errors of a picture after a card has moved, with and without the earlier pictures.
struct MovedCard {
  double kept, worst;  ///< Rms and greatest error.
  double alone;        ///< Rms error of a picture without the earlier ones.
  double before;       ///< Rms error of the picture before.
};

MovedCard moveCard(const ScreenOcclusionOptions& occlusion, const ScreenOcclusionOptions& many) {
  QuadScene card = cardOverFloor();
  const viewer::View view = viewer::makeView(card.inputs(), screenOptions(72, occlusion));
  Picture before, kept;
  {
    Window window(card.inputs());
    for (int i = 0; i < 16; ++i) before = window.draw(view);
    for (std::size_t v = 4; v < 8; ++v) card.compiled.positions[v].x += 0.35f;
    window.renderer.sceneMoved();
    kept = window.draw(view);
  }
  ScreenOcclusionOptions one = occlusion;
  one.frames = 1;
  const Picture truth = card.render(screenOptions(72, many));
  double worst = 0.0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i)
    worst = std::max(worst, std::abs(double{kept.pixels[i].r} - truth.pixels[i].r));
  return {rms(kept, truth), worst, rms(card.render(screenOptions(72, one)), truth), rms(before, truth)};
}

TEST(OcclusionHistory, ObjectThatMoves_LeavesNoGhost) {
  const MovedCard filtered = moveCard(coarse(16), fine());
  EXPECT_LT(filtered.worst, 0.15);
  EXPECT_LT(filtered.kept, 2.0 * filtered.alone);
  EXPECT_LT(filtered.kept, 0.3 * filtered.before);
  const MovedCard raw = moveCard(unfiltered(coarse(16)), unfiltered(fine()));
  EXPECT_LT(raw.kept, raw.alone);
}

TEST(OcclusionHistory, LightThatChanges_IsNotMixedWithThatBefore) {
  const QuadScene card = cardOverFloor();
  viewer::View view = viewer::makeView(card.inputs(), screenOptions(32, coarse(8, OcclusionMethod::Ssdo)));
  view.screenOcclusion.bounces = 0;
  view.lights = {makeLight(LightType::Directional, glm::vec3(3), {}, {0, 0, -1})};
  Window window(card.inputs());
  for (int i = 0; i < 8; ++i) window.draw(view);
  view.lights = {makeLight(LightType::Directional, glm::vec3(3), {}, {0.7, 0, -1})};
  const Picture kept = window.draw(view);
  Window fresh(card.inputs());
  const Picture anew = fresh.draw(view);
  for (std::size_t i = 0; i < anew.pixels.size(); ++i) EXPECT_NEAR(kept.pixels[i].r, anew.pixels[i].r, 1e-4f);
}

}  // namespace
}  // namespace prelight
