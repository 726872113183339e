#include "benchmarks/suites/techniques/compared_techniques.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "occluders/occluder_vectors.h"

namespace prelight::benchmarks {

namespace {

using viewer::OcclusionMethod;
using viewer::RenderOptions;
using viewer::Shading;
using List = std::vector<Technique>;

constexpr int nearLampShells = 8;
constexpr int volumeSize = 32, volumeOrder = 4;

RenderOptions drawn(Shading shading) {
  RenderOptions render;
  render.shading = shading;
  return render;
}

RenderOptions occlusionBy(OcclusionMethod method) {
  RenderOptions render = drawn(Shading::Screen);
  render.screenOcclusion.method = method;
  return render;
}

BakeRequest shOf(int order, int shells) {
  BakeRequest request;
  request.sh.order = order;
  request.nearLamps.shells = shells;
  request.bounces = 1;
  return request;
}

/// Returns the bake that a shading needs by default, with one bounce.
BakeRequest bakeOf(Shading shading) {
  BakeRequest request;
  viewer::infoOf(shading).addTo(request, {});
  request.bounces = 1;
  return request;
}

/// Adds techniques of direct light and of occluded ambient light.
void addOcclusion(List& list) {
  using namespace compared;
  BakeRequest ao, cones, horizons;
  ao.ao = cones.ao = cones.cones = true;
  horizons.horizons.sectors = 8;
  RenderOptions wide = drawn(Shading::Ao);
  wide.aoFilter = viewer::AoFilter::Cosine;
  RenderOptions reflecting = drawn(Shading::Ao);
  reflecting.aoCorrection = viewer::AoCorrection::Interreflection;
  list.push_back({"Phong",
                  drawn(Shading::Phong),
                  {},
                  open | mirrors | room | areaLamps | curve,
                  claims::directLight,
                  ThesisRow{0, 0, 5500, 0}});
  list.push_back({"AO", drawn(Shading::Ao), ao, open, claims::directLight, ThesisRow{58, 0, 5500, 0.019}});
  list.push_back({"AO, wide filter", wide, ao, sky, claims::directLight});
  list.push_back({"AO, interreflection", reflecting, ao, sky, claims::allLight});
  list.push_back({"Cones", drawn(Shading::Cones), cones, open | areaLamps, claims::directLight});
  list.push_back({"Horizons", drawn(Shading::Horizons), horizons, open | areaLamps, claims::directLight});
  list.push_back({"SSAO", occlusionBy(OcclusionMethod::Ssao), {}, sky, claims::directLight});
  list.push_back({"HBAO", occlusionBy(OcclusionMethod::Hbao), {}, sky, claims::directLight});
  list.push_back({"GTAO", occlusionBy(OcclusionMethod::Gtao), {}, sky, claims::directLight});
  list.push_back({"SSDO", occlusionBy(OcclusionMethod::Ssdo), {}, sky, claims::oneBounce});
  list.push_back({"Disks", occlusionBy(OcclusionMethod::Disks), {}, sky, claims::directLight});
  list.push_back({"Fields", occlusionBy(OcclusionMethod::Fields), {}, sky, claims::directLight});
}

Technique vectorOccluders(const std::string& name, OccluderKind kind, unsigned scenes, bool specular) {
  Technique technique{name, drawn(Shading::Vo), {}, scenes, claims::oneBounce};
  technique.request.ao = true;  // the thesis counts it as well
  technique.request.occluders.wanted = true;
  technique.request.occluders.kind = kind;
  technique.request.occluders.records = 12.0;
  OccluderShading& shading = technique.render.occluders.shading;
  if (!specular) shading.diffuseFromSpecular = shading.specularFromSpecular = 0.0;
  return technique;
}

void addHarmonics(int order, bool specular, const ThesisRow& sh, const ThesisRow& ch, List& list) {
  BakeRequest ofSh;
  ofSh.glossy.order = specular ? order : 0;
  ofSh.bounces = 1;
  BakeRequest ofCh = ofSh;
  ofSh.sh.order = ofCh.ch.order = order;
  const char* terms = specular ? "DD+SS" : "DD";
  const unsigned scenes = specular ? compared::mirrors : compared::open;
  list.push_back({fmt::format("SH{}/{}", order, terms), drawn(specular ? Shading::Glossy : Shading::Sh), ofSh,
                  scenes, claims::oneBounce, sh});
  list.push_back({fmt::format("CH{}/{}", order, terms), drawn(specular ? Shading::Glossy : Shading::Ch), ofCh,
                  scenes, claims::oneBounce, ch});
}

/// Adds techniques of transfer, and of baked or computed light of the scene's own lights.
void addBakedLight(int order, int haarSize, List& list) {
  using namespace compared;
  BakeRequest haar;
  haar.haar.size = haarSize;
  haar.bounces = 1;
  list.push_back({"Haar/DD", drawn(Shading::Haar), haar, open, claims::oneBounce});
  list.push_back({fmt::format("SH{}, lamps unshadowed", order), drawn(Shading::Sh), shOf(order, 0),
                  room | areaLamps, claims::directLight});
  list.push_back({fmt::format("SH{}, {} shells", order, nearLampShells), drawn(Shading::Sh),
                  shOf(order, nearLampShells), room | areaLamps, claims::directLight});
  BakeRequest together = shOf(std::min(order, volumeOrder), 0), around = together;
  around.volume.size = volumeSize;
  list.push_back({fmt::format("SH{}, baked with the object", together.sh.order), drawn(Shading::Sh), together,
                  volume, claims::oneBounce});
  list.push_back({fmt::format("SH{}, object lit by a volume", together.sh.order), drawn(Shading::Sh), around,
                  volume, claims::oneBounce});
  list.push_back(
      {"Light groups", drawn(Shading::Lights), bakeOf(Shading::Lights), lamps | room, claims::oneBounce});
  list.push_back({"Radiosity", drawn(Shading::Radiosity), bakeOf(Shading::Radiosity), open | room});
  list.push_back({"Light map", drawn(Shading::LightMap), bakeOf(Shading::LightMap), open | room});
  list.push_back({"Instant radiosity", drawn(Shading::Instant), {}, open | room});
  list.push_back({"Full", drawn(Shading::GlobalIllumination), {}, open | mirrors | room});
}

/// Adds the shadings of techniques that are drawn from numbers of vertices alone.
void addPlainShadings(List& list) {
  for (const viewer::ShadingInfo& info : viewer::shadings())
    if (info.vertexNumbers != nullptr)
      list.push_back({std::string(info.name()), drawn(info.shading), bakeOf(info.shading), compared::open,
                      claims::directLight});
}

}  // namespace

std::vector<Technique> comparedTechniques(int order, int haarSize) {
  using namespace compared;
  List list;
  addOcclusion(list);
  list.push_back(
      vectorOccluders("VO/DD", OccluderKind::Node, open | mirrors | room | areaLamps | curve, false));
  list.back().thesis = ThesisRow{58, 60, 4700, 1.03};
  list.push_back(vectorOccluders("VO/DD auto:12", OccluderKind::Auto, open, false));
  if (order >= 3) addHarmonics(3, false, {60, 63, 5100, 2.07}, {56, 61, 5100, 2.07}, list);
  if (order >= 6) addHarmonics(6, false, {62, 68, 2500, 8.26}, {60, 66, 2500, 8.26}, list);
  addBakedLight(order, haarSize, list);
  addPlainShadings(list);
  list.push_back(vectorOccluders("VO/DD+DS+SS", OccluderKind::Node, open | mirrors | curve, true));
  list.back().thesis = ThesisRow{58, 85, 3500, 2.05};
  if (order >= 3) addHarmonics(3, true, {105, 70, 114, 20.7}, {103, 70, 97, 20.7}, list);
  if (order >= 6) addHarmonics(6, true, {142, 175, 25, 306}, {142, 173, 22, 306}, list);
  return list;
}

std::vector<Technique> techniquesOn(unsigned kind, const std::vector<Technique>& all) {
  std::vector<Technique> chosen;
  std::copy_if(all.begin(), all.end(), std::back_inserter(chosen),
               [&](const Technique& technique) { return (technique.scenes & kind) != 0; });
  return chosen;
}

bool showsMirrors(const Technique& technique) {
  const OccluderShading& shading = technique.render.occluders.shading;
  return technique.render.shading == Shading::Vo &&
         (shading.diffuseFromSpecular != 0.0 || shading.specularFromSpecular != 0.0);
}

bool canShow(const Technique& technique, const Bake& bake) {
  if (!technique.request.anything()) return true;
  if (!viewer::infoOf(technique.render.shading).carriedBy(bake)) return false;
  if (!showsMirrors(technique)) return true;
  const auto& stored = bake.occluders->stored;
  return std::find(stored.begin(), stored.end(), OccluderVector::SpecularNormal) != stored.end();
}

}  // namespace prelight::benchmarks
