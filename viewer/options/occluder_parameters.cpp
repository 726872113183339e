#include "viewer/options/occluder_parameters.h"

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
using Occluding = OccluderOptions;

constexpr std::array<OccluderParameter, 11> occluderParameterTable = {{
    {"--shadow-strength", "shadow strength N_sh", 0.0, 100.0, 0.2, 5.5,
     "width of the shadows of occluders in the thesis' formula (N_sh); the thesis shows 0.2 to 5.5",
     getShading<&S::shadowStrength>, setShading<&S::shadowStrength>},
    {"--caustic-strength", "caustic strength N_c", 0.0, 100.0, 0.0, 4.0,
     "factor for light that glass bends: 1 conserves energy, 0 lets light go straight; N_c in the thesis' "
     "formula",
     getShading<&S::causticStrength>, setShading<&S::causticStrength>},
    {"--bleeding", "bleeding", -100.0, 100.0, -4.0, 4.0,
     "factor for light that diffuse occluders reflect; below 0 they drain colour", getShading<&S::bleeding>,
     setShading<&S::bleeding>},
    {"--diffuse-from-specular", "diffuse from specular", 0.0, 100.0, 0.0, 4.0,
     "factor for light that shiny occluders mirror onto diffuse surfaces",
     getShading<&S::diffuseFromSpecular>, setShading<&S::diffuseFromSpecular>},
    {"--specular-from-specular", "specular from specular", 0.0, 100.0, 0.0, 4.0,
     "factor for light that shiny occluders mirror onto shiny surfaces", getShading<&S::specularFromSpecular>,
     setShading<&S::specularFromSpecular>},
    {"--specular-exponent", "specular exponent", 1.0, 1000.0, 1.0, 1000.0,
     "cosine power of reflections in a small flat occluder; those in large and bent ones are softer",
     getShading<&S::specularExponent>, setShading<&S::specularExponent>},
    {"--waves", "waves", 0.0, 10.0, 0.0, 1.0,
     "bend the directions of shadows and caustics in waves, by angles up to the one with this tangent",
     getEffect<&E::waves>, setEffect<&E::waves>},
    {"--normal-waves", "waves of normals", 0.0, 10.0, 0.0, 1.0,
     "bend the normals of lit surfaces in the same waves, by angles up to the one with this tangent",
     getEffect<&E::normalWaves>, setEffect<&E::normalWaves>},
    {"--wave-length", "wave length, m", 0.0, 1e6, 0.0, 10.0,
     "length of the longest wave, metres; 0: half the scene's radius", getOwn<&Occluding::waveLength>,
     setOwn<&Occluding::waveLength>},
    {"--fire", "fire", 0.0, 1.0, 0.0, 1.0,
     "part of every light's strength that flickers, and reddens as it sinks", getEffect<&E::fire>,
     setEffect<&E::fire>},
    {"--effect-time", "time, s", -1e6, 1e6, 0.0, effectPeriod,
     "moment of waves and fire, seconds; they repeat every 8", getOwn<&Occluding::seconds>,
     setOwn<&Occluding::seconds>},
}};

}  // namespace

std::span<const OccluderParameter> occluderParameters() { return occluderParameterTable; }

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
