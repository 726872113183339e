#include "benchmarks/techniques.h"

#include <fmt/format.h>

#include <algorithm>

namespace prelight::benchmarks {

namespace {

using viewer::Shading;

BakeRequest occludersOf(OccluderKind kind) {
  BakeRequest request;
  request.ao = true;  // the thesis counts it, too
  request.occluders.wanted = true;
  request.occluders.kind = kind;
  request.occluders.records = 12.0;
  return request;
}

BakeRequest glossyOf(int glossyOrder) {
  BakeRequest request;
  request.glossy.order = glossyOrder;
  request.bounces = 1;
  return request;
}

Technique vectorOccluders(const std::string& name, OccluderKind kind, bool specular,
                          std::optional<ThesisRow> thesis) {
  Technique result{name, occludersOf(kind), Shading::Vo, {}, specular, thesis};
  if (!specular) {
    OccluderShading& shading = result.occluders.shading;
    shading.diffuseFromSpecular = shading.specularFromSpecular = 0.0;
  }
  return result;
}

void addHarmonics(int order, bool specular, const ThesisRow& sh, const ThesisRow& ch,
                  std::vector<Technique>& list) {
  BakeRequest ofSh = glossyOf(specular ? order : 0), ofCh = ofSh;
  ofSh.sh.order = ofCh.ch.order = order;
  const char* terms = specular ? "DD+SS" : "DD";
  list.push_back({fmt::format("SH{}/{}", order, terms),
                  ofSh,
                  specular ? Shading::Glossy : Shading::Sh,
                  {},
                  specular,
                  sh});
  list.push_back({fmt::format("CH{}/{}", order, terms),
                  ofCh,
                  specular ? Shading::Glossy : Shading::Ch,
                  {},
                  specular,
                  ch});
}

/// What holds the light of the scene's own lights as it was baked.
void addStaticLight(const char* name, Shading shading, std::vector<Technique>& list) {
  Technique technique{name, {}, shading, {}, false, std::nullopt};
  viewer::infoOf(shading).addTo(technique.request, {});
  technique.request.bounces = 1;
  list.push_back(technique);
}

/// What needs no bake, as it finds occlusion while drawing.
void addScreenOcclusion(const char* name, viewer::OcclusionMethod method, std::vector<Technique>& list) {
  Technique technique{name, {}, Shading::Screen, {}, false, std::nullopt};
  technique.screenOcclusion.method = method;
  list.push_back(technique);
}

}  // namespace

std::vector<Technique> comparedTechniques(int order, int haarSize) {
  BakeRequest ao;
  ao.ao = true;
  BakeRequest haar;
  haar.haar.size = haarSize;
  haar.bounces = 1;
  std::vector<Technique> list = {
      {"Phong", {}, Shading::Phong, {}, false, ThesisRow{0, 0, 5500, 0}},
      {"AO", ao, Shading::Ao, {}, false, ThesisRow{58, 0, 5500, 0.019}},
      vectorOccluders("VO/DD", OccluderKind::Node, false, ThesisRow{58, 60, 4700, 1.03}),
      vectorOccluders("VO/DD auto:12", OccluderKind::Auto, false, std::nullopt)};
  addScreenOcclusion("SSAO", viewer::OcclusionMethod::Ssao, list);
  addScreenOcclusion("HBAO", viewer::OcclusionMethod::Hbao, list);
  addScreenOcclusion("GTAO", viewer::OcclusionMethod::Gtao, list);
  addScreenOcclusion("Disks", viewer::OcclusionMethod::Disks, list);
  if (order >= 3) addHarmonics(3, false, {60, 63, 5100, 2.07}, {56, 61, 5100, 2.07}, list);
  if (order >= 6) addHarmonics(6, false, {62, 68, 2500, 8.26}, {60, 66, 2500, 8.26}, list);
  list.push_back({"Haar/DD", haar, Shading::Haar, {}, false, std::nullopt});
  addStaticLight("Radiosity", Shading::Radiosity, list);
  addStaticLight("Light map", Shading::LightMap, list);
  list.push_back(vectorOccluders("VO/DD+DS+SS", OccluderKind::Node, true, ThesisRow{58, 85, 3500, 2.05}));
  if (order >= 3) addHarmonics(3, true, {105, 70, 114, 20.7}, {103, 70, 97, 20.7}, list);
  if (order >= 6) addHarmonics(6, true, {142, 175, 25, 306}, {142, 173, 22, 306}, list);
  return list;
}

bool canShow(const Technique& technique, const Bake& bake) {
  if (technique.shading != Shading::Phong && !viewer::infoOf(technique.shading).carriedBy(bake)) return false;
  if (technique.shading != Shading::Vo || !technique.specular) return true;
  const auto& stored = bake.occluders->stored;
  return std::find(stored.begin(), stored.end(), OccluderVector::SpecularNormal) != stored.end();
}

}  // namespace prelight::benchmarks
