#include "viewer/programs/drawn_shading.h"

namespace prelight::viewer {
namespace {

constexpr ShadingInfo phongShading = {
    .shading = Shading::Phong,
    .summary = "direct light without shadows",
    .traits = {.skyLampsApart = true, .followsAnimation = true, .objectsInCubes = true},
};

}  // namespace

extern const DrawnShading drawnPhong = {
    .info = &phongShading,
    .vary = [](const View&, Lobe lobe, ShaderVariant& variant) { variant.phongLobe = lobe == Lobe::Phong; },
};

}  // namespace prelight::viewer
