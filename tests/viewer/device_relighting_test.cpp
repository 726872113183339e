// Pictures with transfer that is lit on an OpenCL device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/devices.h"
#include "viewer/open_transfers.h"
#include "viewer/picture_checks.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

TEST(Relighting, OnADevice_ShowsWhatTheHostShows) {
  QuadScene quad = litQuad(true);
  quad.bake.haar = openWavelets(quad.compiled.normals, 16, 3);
  quad.bake.glossy = openMatrices(quad.compiled.normals, 4, 3);
  for (const Shading shading : {Shading::Haar, Shading::Glossy}) {
    viewer::RenderInputs inputs = quad.inputs();
    Warnings notes;
    const Picture onHost = viewer::renderPicture(inputs, square(shading), notes);
    inputs.device = &sharedDevice();
    const Picture onDevice = viewer::renderPicture(inputs, square(shading), notes);
    EXPECT_LT(largestDifference(onHost, onDevice), 1e-5 * largest(onHost)) << shadingName(shading);
    EXPECT_THAT(notes, testing::IsEmpty());
  }
}

}  // namespace
}  // namespace prelight
