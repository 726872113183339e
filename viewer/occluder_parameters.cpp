#include "viewer/occluder_parameters.h"

#include <algorithm>
#include <array>

#include "occluders/wave_table.h"

namespace prelight::viewer {
namespace {

template <auto member>
double getShading(const OccluderOptions& o) {
  return o.shading.*member;
}
template <auto member>
void setShading(OccluderOptions& o, double value) {
  o.shading.*member = value;
}
template <auto member>
double getEffect(const OccluderOptions& o) {
  return o.shading.effects.*member;
}
template <auto member>
void setEffect(OccluderOptions& o, double value) {
  o.shading.effects.*member = value;
}
template <auto member>
double getOwn(const OccluderOptions& o) {
  return o.*member;
}
template <auto member>
void setOwn(OccluderOptions& o, double value) {
  o.*member = value;
}

using S = OccluderShading;
using E = OccluderEffects;
using O = OccluderOptions;

constexpr std::array<OccluderParameter, 11> parameterTable = {{
    {"--shadow-strength", "shadow strength N_sh", 0.0, 100.0, 0.2, 5.5,
     "how wide occluders shadow in the thesis' formula (N_sh); the thesis shows 0.2 to 5.5",
     getShading<&S::shadowStrength>, setShading<&S::shadowStrength>},
    {"--caustic-strength", "caustic strength N_c", 0.0, 100.0, 0.0, 4.0,
     "light that glass bends: its factor, where 1 keeps the energy, and N_c in the thesis' formula; 0 lets "
     "it go "
     "straight",
     getShading<&S::causticStrength>, setShading<&S::causticStrength>},
    {"--bleeding", "bleeding", -100.0, 100.0, -4.0, 4.0,
     "factor of the light that diffuse occluders send on; below 0 they drain colour",
     getShading<&S::bleeding>, setShading<&S::bleeding>},
    {"--diffuse-from-specular", "diffuse from specular", 0.0, 100.0, 0.0, 4.0,
     "factor of the light that shiny occluders mirror onto diffuse surfaces",
     getShading<&S::diffuseFromSpecular>, setShading<&S::diffuseFromSpecular>},
    {"--specular-from-specular", "specular from specular", 0.0, 100.0, 0.0, 4.0,
     "factor of the light that shiny occluders mirror onto shiny surfaces",
     getShading<&S::specularFromSpecular>, setShading<&S::specularFromSpecular>},
    {"--specular-exponent", "specular exponent", 1.0, 1000.0, 1.0, 1000.0,
     "cosine power of what a small flat occluder mirrors; large and bent ones are softer",
     getShading<&S::specularExponent>, setShading<&S::specularExponent>},
    {"--waves", "waves", 0.0, 10.0, 0.0, 1.0,
     "bend the directions of shadows and caustics by up to the angle of this tangent, in waves",
     getEffect<&E::waves>, setEffect<&E::waves>},
    {"--normal-waves", "waves of normals", 0.0, 10.0, 0.0, 1.0,
     "bend the normals that light falls on by up to the angle of this tangent, in the same waves",
     getEffect<&E::normalWaves>, setEffect<&E::normalWaves>},
    {"--wave-length", "wave length, m", 0.0, 1e6, 0.0, 10.0,
     "of the longest wave, metres; 0: half the scene's radius", getOwn<&O::waveLength>,
     setOwn<&O::waveLength>},
    {"--fire", "fire", 0.0, 1.0, 0.0, 1.0,
     "part of every light's strength that flickers, and reddens as it sinks", getEffect<&E::fire>,
     setEffect<&E::fire>},
    {"--effect-time", "time, s", -1e6, 1e6, 0.0, effectPeriod,
     "moment of waves and fire, seconds; they repeat every 8", getOwn<&O::seconds>, setOwn<&O::seconds>},
}};

}  // namespace

std::span<const OccluderParameter> occluderParameters() { return parameterTable; }

OccluderOptions withinRanges(OccluderOptions options) {
  options = withinRanges(options, occluderParameters());
  options.skyLights = std::clamp(options.skyLights, 1, mostSkyLights);
  return options;
}

bool areAnimated(const OccluderOptions& options) {
  const OccluderEffects& effects = options.shading.effects;
  return effects.waves > 0.0 || effects.normalWaves > 0.0 || effects.fire > 0.0;
}

}  // namespace prelight::viewer
