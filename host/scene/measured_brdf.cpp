#include "scene/measured_brdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/files.h"
#include "base/parallel.h"
#include "prelight/measured_brdf.h"
#include "scene/codecs/merl_brdf.h"

namespace prelight {

namespace {

using std::numbers::pi;

/// Two neighbouring indices along one of the angles, and the position between them.
struct Neighbours {
  int first = 0, second = 0;
  double share = 0.0;
};

Neighbours between(double place, int count) {
  const double clamped = std::clamp(place - 0.5, 0.0, count - 1.0);
  const int first = std::min(static_cast<int>(clamped), count - 2);
  return {first, first + 1, clamped - first};
}

/// Returns the neighbours of a place on a circle: the last index is next to the first.
Neighbours around(double place, int count) {
  const double shifted = place - 0.5 + count;
  const int first = static_cast<int>(shifted);
  return {first % count, (first + 1) % count, shifted - first};
}

}  // namespace

std::size_t brdfCell(int half, int difference, int turn) {
  return (static_cast<std::size_t>(half) * MeasuredBrdf::differences + static_cast<std::size_t>(difference)) *
             MeasuredBrdf::turns +
         static_cast<std::size_t>(turn);
}

glm::dvec3 brdfAt(std::span<const glm::vec3> cells, const glm::dvec3& wo, const glm::dvec3& wi) {
  const glm::dvec3 h = glm::normalize(wo + wi);
  const double across = std::hypot(h.x, h.y);
  const glm::dvec2 way = across > 1e-9 ? glm::dvec2(h) / across : glm::dvec2(1.0, 0.0);
  // wi in the frame of the half vector.
  const double x = h.z * (wi.x * way.x + wi.y * way.y) - across * wi.z, y = wi.y * way.x - wi.x * way.y,
               z = glm::dot(wi, h);
  const double half = std::sqrt(std::clamp(std::atan2(across, h.z) * 2.0 / pi, 0.0, 1.0));
  const double turn = std::atan2(y, x) / pi;
  const Neighbours a = between(half * MeasuredBrdf::halves, MeasuredBrdf::halves);
  const Neighbours b = between(std::atan2(std::hypot(x, y), z) * 2.0 / pi * MeasuredBrdf::differences,
                               MeasuredBrdf::differences);
  const Neighbours c = around((turn - std::floor(turn)) * MeasuredBrdf::turns, MeasuredBrdf::turns);
  const auto alongTurn = [&](int i, int j) {
    return glm::mix(glm::dvec3(cells[brdfCell(i, j, c.first)]), glm::dvec3(cells[brdfCell(i, j, c.second)]),
                    c.share);
  };
  const auto alongDifference = [&](int i) {
    return glm::mix(alongTurn(i, b.first), alongTurn(i, b.second), b.share);
  };
  return glm::mix(alongDifference(a.first), alongDifference(a.second), a.share);
}

glm::dvec2 cosinesOfCell(int half, int difference, int turn) {
  const double root = (half + 0.5) / MeasuredBrdf::halves, theta = 0.5 * pi * root * root;
  const double apart = 0.5 * pi * (difference + 0.5) / MeasuredBrdf::differences;
  const double azimuth = pi * (turn + 0.5) / MeasuredBrdf::turns;
  const double along = std::cos(theta) * std::cos(apart);
  const double across = std::sin(theta) * std::sin(apart) * std::cos(azimuth);
  return {along + across, along - across};
}

namespace {

using std::numbers::pi;

constexpr int halves = MeasuredBrdf::halves, differences = MeasuredBrdf::differences,
              turns = MeasuredBrdf::turns, cosines = MeasuredBrdf::cosines;
/// The diffuse part is estimated from cells in which both cosines are at least this: measurements of grazing
/// light are the least certain.
constexpr double grazing = 0.25;

using Cells = std::vector<glm::vec3>;

bool isMeasured(const glm::vec3& value) { return value.x >= 0.0f && value.y >= 0.0f && value.z >= 0.0f; }

template <typename Use>
void forCells(const Use& use) {
  for (int i = 0; i < halves; ++i)
    for (int j = 0; j < differences; ++j)
      for (int k = 0; k < turns; ++k) use(i, j, k, brdfCell(i, j, k));
}

/// Fills a column of difference angles from its own values. Returns false when it has none.
bool fillColumn(int half, int turn, Cells& cells) {
  std::optional<glm::vec3> last;
  for (int j = 0; j < differences && !last; ++j)
    if (isMeasured(cells[brdfCell(half, j, turn)])) last = cells[brdfCell(half, j, turn)];
  if (!last) return false;
  for (int j = 0; j < differences; ++j) {
    glm::vec3& value = cells[brdfCell(half, j, turn)];
    if (isMeasured(value))
      last = value;
    else
      value = *last;
  }
  return true;
}

/// Fills cells without measurement by the nearest value of a smaller difference angle, otherwise of a larger
/// one, otherwise of the next half angle. Returns the share of the cells above the horizon that were filled.
double fillCells(const std::string& where, Cells& cells) {
  std::size_t above = 0, missing = 0;
  forCells([&](int i, int j, int k, std::size_t cell) {
    const glm::dvec2 c = cosinesOfCell(i, j, k);
    if (c.x < 0.0 || c.y < 0.0) {
      cells[cell] = glm::vec3(-1.0f);  // values below the horizon are ignored
      return;
    }
    ++above;
    if (!isMeasured(cells[cell])) ++missing;
  });
  for (int k = 0; k < turns; ++k) {
    std::array<bool, halves> filled{};
    for (int i = 0; i < halves; ++i) filled[static_cast<std::size_t>(i)] = fillColumn(i, k, cells);
    const auto first = std::find(filled.begin(), filled.end(), true);
    if (first == filled.end())
      throw InputError(where, fmt::format("nothing was measured at turn {}", k),
                       "get the file from its source again");
    int from = static_cast<int>(first - filled.begin());
    for (int i = 0; i < halves; ++i) {
      if (filled[static_cast<std::size_t>(i)]) {
        from = i;
        continue;
      }
      for (int j = 0; j < differences; ++j) cells[brdfCell(i, j, k)] = cells[brdfCell(from, j, k)];
    }
  }
  return double(missing) / double(above);
}

double cosineOfStep(int step) {
  const double root = std::max(double(step), 0.05) / (cosines - 1);
  return root * root;
}

std::vector<glm::vec3> albedosOf(const std::vector<HalfVector>& samples, const Cells& cells) {
  std::vector<glm::vec3> albedos(cosines);
  parallelRanges(cosines, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t step = begin; step < end; ++step) {
      const glm::dvec3 wo = directionOfCosine(cosineOfStep(static_cast<int>(step)));
      glm::dvec3 sum(0.0);
      forReflected(samples, wo, [&](const glm::dvec3& wi, const glm::dvec3&, double weight) {
        sum += brdfAt(cells, wo, wi) * (wi.z * weight);
      });
      albedos[step] = glm::vec3(sum);
    }
  });
  return albedos;
}

double largest(const std::vector<glm::vec3>& values) {
  float most = 0.0f;
  for (const glm::vec3& v : values) most = std::max({most, v.x, v.y, v.z});
  return double(most);
}

/// Scales values by the smaller of both directions' factors until no direction reflects more light than
/// arrives. Returns the largest albedo before.
double limitEnergy(const std::vector<HalfVector>& samples, Cells& cells) {
  constexpr int mostRounds = 8;
  constexpr double rounding = 1e-4;
  double before = 0.0;
  for (int round = 0; round < mostRounds; ++round) {
    const std::vector<glm::vec3> albedos = albedosOf(samples, cells);
    if (round == 0) before = largest(albedos);
    if (largest(albedos) <= 1.0 + (round == 0 ? 10.0 : 1.0) * rounding) break;
    forCells([&](int i, int j, int k, std::size_t cell) {
      const glm::dvec2 c = cosinesOfCell(i, j, k);
      const glm::dvec3 there = glm::max(albedoAt(albedos, c.x), albedoAt(albedos, c.y));
      cells[cell] /= glm::vec3(glm::max(there, glm::dvec3(1.0)));
    });
  }
  return before;
}

glm::vec3 leastBrdf(const Cells& cells) {
  glm::vec3 least(std::numeric_limits<float>::max());
  forCells([&](int i, int j, int k, std::size_t cell) {
    const glm::dvec2 c = cosinesOfCell(i, j, k);
    if (c.x >= grazing && c.y >= grazing) least = glm::min(least, cells[cell]);
  });
  return least;
}

/// Returns the density with which a GGX lobe of a width is sampled: D G1 / (4 cos), Heitz 2014, eq. 17, as in
/// kernels/transport/microfacet_funcs.cl.
double facetDensity(const glm::dvec3& wo, const glm::dvec3& h, double alpha) {
  const double a2 = alpha * alpha, q = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
  return 0.5 * a2 / (pi * q * q) / (wo.z + std::sqrt(a2 + (1.0 - a2) * wo.z * wo.z));
}

/// Chooses the sampling of the non-diffuse rest that minimises the mean square of the samples' weights over
/// some directions.
void chooseSampling(const std::vector<HalfVector>& samples, MeasuredBrdf& brdf) {
  constexpr int widths = 24;
  constexpr std::array<double, 9> shares = {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 0.95};
  constexpr std::array<double, 4> heights = {0.95, 0.7, 0.4, 0.15};
  const auto alphaOf = [](std::size_t i) { return std::pow(0.06, 2.0 * (1.0 - double(i) / (widths - 1))); };
  std::vector<std::array<double, shares.size()>> squares(widths);
  parallelRanges(widths, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w)
      for (const double height : heights) {
        const glm::dvec3 wo = directionOfCosine(height);
        const double whole = std::max(glm::dot(albedoAt(brdf.albedos, height), glm::dvec3(1.0)), 1e-6);
        forReflected(samples, wo, [&](const glm::dvec3& wi, const glm::dvec3& h, double weight) {
          const glm::dvec3 rest = glm::max(brdfAt(brdf.rest, wo, wi), glm::dvec3(0.0));
          const double value = (rest.x + rest.y + rest.z) * wi.z / whole;
          for (std::size_t s = 0; s < shares.size(); ++s)
            squares[w][s] += weight * value * value /
                             (shares[s] * wi.z / pi + (1.0 - shares[s]) * facetDensity(wo, h, alphaOf(w)));
        });
      }
  });
  double least = std::numeric_limits<double>::max();
  for (std::size_t w = 0; w < widths; ++w)
    for (std::size_t s = 0; s < shares.size(); ++s) {
      if (squares[w][s] >= least) continue;
      least = squares[w][s];
      brdf.roughness = static_cast<float>(std::sqrt(alphaOf(w)));
      brdf.cosineShare = static_cast<float>(shares[s]);
    }
}

void tell(const std::string& where, double missing, double brightest, Warnings& warnings) {
  if (missing > 0.01)
    warnings.push_back(fmt::format(
        "{}: {:.1f} % of the directions above the surface were not measured; their neighbours replace them",
        where, 100.0 * missing));
  if (brightest > 1.001)
    warnings.push_back(
        fmt::format("{}: it would reflect up to {:.3g} times the light that arrives; it was scaled down to "
                    "reflect all of it",
                    where, brightest));
}

}  // namespace

glm::dvec3 albedoAt(const std::vector<glm::vec3>& albedos, double cosine) {
  const double place = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * double(albedos.size() - 1);
  const std::size_t first = std::min(static_cast<std::size_t>(place), albedos.size() - 2);
  return glm::mix(glm::dvec3(albedos[first]), glm::dvec3(albedos[first + 1]), place - double(first));
}

MeasuredBrdf makeMeasuredBrdf(std::vector<glm::vec3> values, const std::string& where, Warnings& warnings) {
  const double missing = fillCells(where, values);
  const std::vector<HalfVector> samples = halfVectors();
  tell(where, missing, limitEnergy(samples, values), warnings);
  MeasuredBrdf brdf;
  brdf.name = where;
  const glm::vec3 least = leastBrdf(values);
  brdf.diffuse = glm::vec3(glm::dvec3(least) * pi);
  bool more = false;
  for (glm::vec3& value : values) {
    value -= least;
    more = more || value != glm::vec3(0.0f);
  }
  if (!more) return brdf;
  brdf.rest = std::move(values);
  brdf.albedos = albedosOf(samples, brdf.rest);
  for (glm::vec3& albedo : brdf.albedos) albedo = glm::max(albedo, glm::vec3(0.0f));
  chooseSampling(samples, brdf);
  return brdf;
}

namespace {

/// Returns all materials of that name, otherwise the one of that number.
std::vector<std::size_t> materialsOf(const Scene& scene, const std::string& asked) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].name == asked) found.push_back(i);
  for (std::size_t i = 0; found.empty() && i < scene.materials.size(); ++i)
    if (std::to_string(i) == asked) return {i};
  return found;
}

[[noreturn]] void failForMaterial(const Scene& scene, const std::string& asked) {
  std::string list;
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    list += fmt::format("{}{} \"{}\"", i == 0 ? "" : ", ", i, scene.materials[i].name);
  throw UsageError(fmt::format("LoadOptions::brdfs {}", asked),
                   "there is no material with that name or number",
                   list.empty() ? "the file has none" : "the file has " + list);
}

}  // namespace

std::shared_ptr<const MeasuredBrdf> readMeasured(const std::filesystem::path& file, Warnings& warnings) {
  const std::string where = file.string();
  std::vector<glm::vec3> values = parseMerlBrdf(readFileBytes(file, where, merlBytes + 1), where);
  return std::make_shared<const MeasuredBrdf>(makeMeasuredBrdf(std::move(values), where, warnings));
}

void setMeasured(const std::shared_ptr<const MeasuredBrdf>& brdf, Material& material) {
  Material measured;
  measured.name = material.name;
  measured.emission = material.emission;
  measured.emissiveTexture = material.emissiveTexture;
  measured.normalTexture = material.normalTexture;
  measured.normalScale = material.normalScale;
  measured.alphaMode = material.alphaMode;
  measured.alphaCutoff = material.alphaCutoff;
  measured.doubleSided = material.doubleSided;
  measured.baseColor = glm::vec4(brdf->diffuse, material.baseColor.a);
  if (material.alphaMode != AlphaMode::Opaque) measured.baseColorTexture = material.baseColorTexture;
  measured.metallic = 0.0f;
  measured.roughness = brdf->roughness;
  measured.ior = 0.0f;  // the colour is the reflectance
  measured.specular = brdf->rest.empty() ? 0.0f : 1.0f;
  if (!brdf->albedos.empty())
    measured.specularColor = glm::min(glm::vec3(albedoAt(brdf->albedos, 1.0)), glm::vec3(1.0f));
  measured.measured = brdf;
  material = measured;
}

void giveMeasured(Scene& scene, const std::vector<MaterialBrdf>& brdfs, Warnings& warnings) {
  std::map<std::filesystem::path, std::shared_ptr<const MeasuredBrdf>> read;
  for (const MaterialBrdf& asked : brdfs) {
    const std::vector<std::size_t> materials = materialsOf(scene, asked.material);
    if (materials.empty()) failForMaterial(scene, asked.material);
    const auto [brdf, isNew] = read.try_emplace(asked.file);
    if (isNew) brdf->second = readMeasured(asked.file, warnings);
    for (const std::size_t i : materials) setMeasured(brdf->second, scene.materials[i]);
  }
}

}  // namespace prelight
