#include "gpu/albedo_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "gpu/anisotropic_table.h"
#include "gpu/film_table.h"
#include "scene/lobes.h"
#include "shared/albedo_types.h"

namespace prelight {

namespace {

constexpr int cosines = PRELIGHT_ALBEDO_COSINES, roughnesses = PRELIGHT_ALBEDO_ROUGHNESSES;
constexpr int turns = 16, heights = 48;  ///< steps of the quadrature over visible normals

/// Returns (1 - cosine)^5 (Schlick 1994), as kernels/transport/lobe_funcs.cl does.
double schlickRise(double cosine) {
  const double k = std::clamp(1.0 - cosine, 0.0, 1.0), k2 = k * k;
  return k2 * k2 * k;
}

/// Returns cosine sqrt(1 + alpha2 tan2) (Heitz 2014).
double smithTerm(double cosine, double alpha) {
  return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine);
}

/// Light of an even sky that leaves at the first bounce, for the constant part and for the rise of Schlick's
/// reflectance.
struct FirstBounce {
  glm::dvec2 albedo{0.0};
  glm::dvec4 lean{0.0};  ///< lobeLean() of kernels/transport/albedo_table_funcs.cl
};

/// Averages over the normals visible along a direction of this cosine (Dupuy and Benyoub 2023) the share of
/// light that leaves, G2 / G1.
FirstBounce firstBounce(double cosine, double alpha) {
  const glm::dvec3 wo(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  const glm::dvec3 v = glm::normalize(glm::dvec3(alpha * wo.x, 0.0, wo.z));
  const glm::dvec3 mirrored(-wo.x, 0.0, wo.z), inward(wo.z, 0.0, wo.x);
  FirstBounce sum;
  for (int y = 0; y < heights; ++y) {
    // Steps shrink towards normals perpendicular to the stretched view direction, as hardly any others matter
    // for smooth surfaces.
    const double step = (y + 0.5) / heights, weight = 3.0 * step * step;
    const double z = 1.0 - (1.0 - step * step * step) * (1.0 + v.z);
    const double radius = std::sqrt(std::max(1.0 - z * z, 0.0));
    for (int x = 0; x < turns; ++x) {  // the other half is symmetric
      const double turn = std::numbers::pi * (x + 0.5) / turns;
      const glm::dvec3 c = glm::dvec3(radius * std::cos(turn), radius * std::sin(turn), z) + v;
      const glm::dvec3 h = glm::normalize(glm::dvec3(alpha * c.x, alpha * c.y, std::max(c.z, 1e-9)));
      const double along = glm::dot(wo, h), to = 2.0 * along * h.z - wo.z;
      if (to <= 0.0) continue;
      const double from = smithTerm(wo.z, alpha), toTerm = smithTerm(to, alpha);
      const double leaves = to * (wo.z + from) / (wo.z * toTerm + to * from), rise = schlickRise(along);
      const glm::dvec2 shares = weight * leaves / double(turns * heights) * glm::dvec2(1.0 - rise, rise);
      const glm::dvec3 wi = 2.0 * along * h - wo;
      const glm::dvec2 lean(1.0 - glm::dot(wi, mirrored), glm::dot(wi, inward));
      sum.albedo += shares;
      sum.lean += glm::dvec4(shares.x * lean, shares.y * lean);
    }
  }
  return sum;
}

/// Returns the fit of Lambda of Estevez and Kulla 2017, as in kernels/transport/layer_funcs.cl.
double sheenFit(double x, double alpha) {
  const double k = (1.0 - alpha) * (1.0 - alpha);
  const auto between = [&](double rough, double sharp) { return rough + (sharp - rough) * k; };
  return between(21.5473, 25.3245) /
             (1.0 + between(3.82987, 3.32435) * std::pow(x, between(0.19823, 0.16801))) +
         between(-1.97760, -1.27393) * x + between(-4.32054, -4.85967);
}

double sheenLambda(double cosine, double alpha) {
  return cosine < 0.5 ? std::exp(sheenFit(cosine, alpha))
                      : std::exp(2.0 * sheenFit(0.5, alpha) - sheenFit(std::max(1.0 - cosine, 1e-6), alpha));
}

/// Returns the reflectance of sheen of colour 1 along a direction: an integral over outgoing directions, with
/// steps that grow from the horizon, where most light leaves.
double sheenReflectance(double cosine, double alpha) {
  constexpr int sheenTurns = 24, sheenHeights = 24;
  const glm::dvec3 wo(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  const double from = sheenLambda(std::max(cosine, 1e-4), alpha), inverse = 1.0 / alpha;
  double sum = 0.0;
  for (int y = 0; y < sheenHeights; ++y) {
    const double root = (y + 0.5) / sheenHeights, z = root * root, radius = std::sqrt(1.0 - z * z);
    const double to = sheenLambda(std::max(z, 1e-4), alpha);
    for (int x = 0; x < sheenTurns; ++x) {
      const double turn = std::numbers::pi * (x + 0.5) / sheenTurns;
      const glm::dvec3 h =
          glm::normalize(wo + glm::dvec3(radius * std::cos(turn), radius * std::sin(turn), z));
      const double density = (2.0 + inverse) * std::pow(std::max(1.0 - h.z * h.z, 0.0), 0.5 * inverse) /
                             (2.0 * std::numbers::pi);
      sum += 2.0 * root * density / (1.0 + from + to);
    }
  }
  return sum * 2.0 * std::numbers::pi / (sheenTurns * sheenHeights * 4.0 * std::max(cosine, 1e-6));
}

/// Fills a row at the cosines of the table. For grazing light the first entry takes a cosine slightly above
/// 0.
void fillRow(int r, bool sheen, std::vector<glm::vec4>& table, std::vector<glm::vec4>& leans) {
  const double root = double(r) / (roughnesses - 1), alpha = std::max(std::pow(root, 4.0), 1e-4);
  for (int c = 0; c < cosines; ++c) {
    const double step = std::max(double(c), 0.05) / (cosines - 1);
    const FirstBounce first = firstBounce(std::min(step * step, 1.0), alpha);
    const double roughness = std::max(root * root, double(PRELIGHT_LEAST_SHEEN_ROUGHNESS));
    const double reflected =
        sheen ? sheenReflectance(std::min(step * step, 1.0), roughness * roughness) : 0.0;
    table[r * cosines + c] = glm::vec4(first.albedo.x, first.albedo.y, std::min(reflected, 1.0), 0.0);
    leans[r * cosines + c] = glm::vec4(first.lean);
  }
}

/// Returns the cosine-weighted mean over directions of the looked-up values, exactly for interpolation over
/// roots of cosines. With s = sqrt(cosine) the weight is 4 s^3 ds.
glm::vec4 meanOfRow(int r, const std::vector<glm::vec4>& table) {
  glm::dvec4 sum(0.0);
  const double step = 1.0 / (cosines - 1);
  for (int c = 0; c + 1 < cosines; ++c) {
    const double a = c * step, b = a + step;
    const double whole = std::pow(b, 4) - std::pow(a, 4);          // integral of the weight
    const double first = 0.8 * (std::pow(b, 5) - std::pow(a, 5));  // integral of the weight times s
    const double upper = (first - a * whole) / step;
    const glm::dvec4 left(table[r * cosines + c]), right(table[r * cosines + c + 1]);
    sum += left * (whole - upper) + right * upper;
  }
  return glm::vec4(sum);
}

/// Returns the share of unpolarised light that a dielectric reflects; eta is the ior beyond over the ior
/// here.
double fresnel(double cosine, double eta) {
  const double sine2 = (1.0 - cosine * cosine) / (eta * eta);
  if (sine2 >= 1.0) return 1.0;
  const double beyond = std::sqrt(1.0 - sine2);
  const double s = (cosine - eta * beyond) / (cosine + eta * beyond),
               p = (eta * cosine - beyond) / (eta * cosine + beyond);
  return 0.5 * (s * s + p * p);
}

/// Returns the largest channel of glassReflectances() of kernels/transport/glass_funcs.cl; eta is the ior
/// beyond over the ior here.
double reflectedBy(const GlassSurface& s, double cosine, double eta) {
  const double bare = eta > 0.0 ? fresnel(cosine, eta) : 1.0;
  if (bare >= 1.0 || s == glassOfIor(s.ior)) return bare;
  const double root = (eta - 1.0) / (eta + 1.0), least = root * root;
  const double rise = std::clamp((bare - least) / std::max(1.0 - least, 1e-6), 0.0, 1.0);
  glm::dvec3 reflected = glm::mix(s.f0, glm::dvec3(s.f90), rise);
  if (s.filmShare > 0.0) {
    const double outer2 = eta < 1.0 ? 1.0 - (1.0 - cosine * cosine) / (eta * eta) : cosine * cosine;
    const glm::dvec3 film =
        filmReflectance(std::sqrt(std::max(outer2, 0.0)), s.filmOutside, s.filmIor, s.filmThickness, s.f0);
    reflected = glm::mix(reflected, film, s.filmShare);
  }
  return std::max({reflected.x, reflected.y, reflected.z});
}

/// Returns the share reflected and refracted at the normals visible along a direction that is not masked on
/// the way out.
double scatteredOnce(double cosine, double alpha, const GlassSurface& surface, bool inside) {
  const double eta = inside && surface.ior > 0.0 ? 1.0 / surface.ior : surface.ior;
  constexpr int glassTurns = 12, glassHeights = 32;
  const glm::dvec3 wo(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  const glm::dvec3 v = glm::normalize(glm::dvec3(alpha * wo.x, 0.0, wo.z));
  double sum = 0.0;
  for (int y = 0; y < glassHeights; ++y) {
    const double step = (y + 0.5) / glassHeights;
    const double z = 1.0 - (1.0 - step * step * step) * (1.0 + v.z),
                 radius = std::sqrt(std::max(1.0 - z * z, 0.0));
    for (int x = 0; x < glassTurns; ++x) {
      const double turn = std::numbers::pi * (x + 0.5) / glassTurns;
      const glm::dvec3 c = glm::dvec3(radius * std::cos(turn), radius * std::sin(turn), z) + v;
      const glm::dvec3 h = glm::normalize(glm::dvec3(alpha * c.x, alpha * c.y, std::max(c.z, 1e-9)));
      const double along = std::clamp(glm::dot(wo, h), 1e-9, 1.0), to = 2.0 * along * h.z - wo.z;
      const double reflected = reflectedBy(surface, along, eta), from = smithTerm(wo.z, alpha);
      double leaves = 0.0;
      if (to > 0.0) leaves += reflected * to * (wo.z + from) / (wo.z * smithTerm(to, alpha) + to * from);
      if (reflected < 1.0) {
        const double refracted = std::sqrt(1.0 - (1.0 - along * along) / (eta * eta));
        const double down = -((along / eta - refracted) * h.z - wo.z / eta);
        if (down > 0.0) leaves += (1.0 - reflected) * 2.0 * down / (down + smithTerm(down, alpha));
      }
      sum += 3.0 * step * step * leaves;
    }
  }
  return sum / double(glassTurns * glassHeights);
}

}  // namespace

GlassSurface glassOfIor(double ior) {
  const double root = ior == 0.0 ? 1.0 : (ior - 1.0) / (ior + 1.0);
  GlassSurface surface;
  surface.ior = ior;
  surface.f0 = glm::dvec3(root * root);
  return surface;
}

std::vector<glm::vec4> makeGlassTable(const GlassSurface& surface) {
  constexpr int columns = PRELIGHT_GLASS_COSINES, rows = PRELIGHT_GLASS_ROUGHNESSES;
  std::vector<glm::vec4> table(columns * rows);
  parallelRanges(rows, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      for (int c = 0; c < columns; ++c) {
        const double root = double(r) / (rows - 1), alpha = std::max(std::pow(root, 4.0), 1e-4);
        const double step = std::max(double(c), 0.05) / (columns - 1), cosine = std::min(step * step, 1.0);
        table[r * columns + c] = glm::vec4(scatteredOnce(cosine, alpha, surface, false),
                                           scatteredOnce(cosine, alpha, surface, true), 0.0, 0.0);
      }
  });
  return table;
}

std::vector<glm::vec4> makeAlbedoTable(bool sheen) {
  std::vector<glm::vec4> table(cosines * roughnesses), leans(table.size());
  parallelRanges(roughnesses, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) fillRow(static_cast<int>(r), sheen, table, leans);
  });
  for (int r = 0; r < roughnesses; ++r) table.push_back(meanOfRow(r, table));
  table.insert(table.end(), leans.begin(), leans.end());
  return table;
}

namespace {

/// Appends a table and returns where it begins.
std::uint32_t appendTable(const std::vector<glm::vec4>& more, std::vector<glm::vec4>& table) {
  const auto first = static_cast<std::uint32_t>(table.size());
  table.insert(table.end(), more.begin(), more.end());
  return first;
}

/// Returns the glass of a material without its textures.
GlassSurface glassSurfaceOf(const CompiledMaterial& m) {
  GlassSurface surface = glassOfIor(double(m.ior));
  surface.f90 = double(m.specular);
  surface.f0 = surface.f90 * glm::min(surface.f0 * glm::dvec3(m.specularColor), glm::dvec3(1.0));
  if (!hasFilm(m)) return surface;
  surface.filmShare = double(m.iridescence.factor);
  surface.filmOutside = 1.0 + 0.5 * double(m.clearcoat.factor);
  surface.filmIor = double(m.iridescence.ior);
  surface.filmThickness = double(m.iridescence.thicknessMaximum);
  return surface;
}

}  // namespace

SceneAlbedos makeSceneAlbedos(const CompiledScene& scene, const std::vector<bool>& used) {
  const std::size_t count = scene.materials.size();
  bool sheen = false, anisotropic = false;
  for (std::size_t i = 0; i < count; ++i) {
    sheen = sheen || (used[i] && hasSheen(scene.materials[i]));
    anisotropic = anisotropic || (used[i] && isAnisotropic(scene.materials[i]));
  }
  SceneAlbedos albedos{makeAlbedoTable(sheen), std::vector<std::uint32_t>(count, 0),
                       std::vector<std::uint32_t>(count, 0)};
  if (anisotropic) appendTable(makeAnisotropicTable(), albedos.texels);
  std::vector<std::pair<GlassSurface, std::uint32_t>> glass;  // equal surfaces share a table
  for (std::size_t i = 0; i < count; ++i) {
    const CompiledMaterial& m = scene.materials[i];
    if (used[i] && hasFilm(m) && reflectsSpecularly(m))
      albedos.filmTables[i] = appendTable(makeFilmTable(m), albedos.texels);
    if (!used[i] || !m.solid || !isRoughGlass(m)) continue;
    const GlassSurface surface = glassSurfaceOf(m);
    auto known = std::find_if(glass.begin(), glass.end(), [&](const auto& g) { return g.first == surface; });
    if (known == glass.end())
      known = glass.insert(known, {surface, appendTable(makeGlassTable(surface), albedos.texels)});
    albedos.glassTables[i] = known->second;
  }
  return albedos;
}

}  // namespace prelight
