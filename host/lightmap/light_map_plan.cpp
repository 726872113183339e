#include "lightmap/light_map_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightmap/direct_light_part.h"

namespace prelight {

namespace {

constexpr std::uint64_t bytesPerTexel = 64;  // values, places, bitmaps, and a picture while it is written
constexpr std::uint64_t bytesPerTriangle = 200;

/// m2, fronts and backs.
double litArea(const CompiledScene& scene) {
  double sum = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[t]];
    const double area = 0.5 * glm::length(geometricNormal(scene, t));
    for (const bool back : {false, true})
      if (hasLight(material, back)) sum += area;
  }
  return sum;
}

double texelCount(const CompiledScene& scene, const BakeRequest& request) {
  if (request.lightMapTexel <= 0.0) return lightMapRequest(request).texels;
  return litArea(scene) / (request.lightMapTexel * request.lightMapTexel);
}

std::string texelText(const CompiledScene& scene, const BakeRequest& request) {
  return request.lightMapTexel > 0.0
             ? fmt::format("texels of {:g} m, about {:.0f}", request.lightMapTexel,
                           texelCount(scene, request))
             : fmt::format("about {} texels, because no size is asked for", lightMapRequest(request).texels);
}

PlannedPass planDirect(const CompiledScene& scene) {
  if (!hasLights(scene))
    return {"direct light of the map", false, "the scene has no light and nothing emissive"};
  const auto emitters = std::count_if(scene.triangleMaterials.begin(), scene.triangleMaterials.end(),
                                      [&](std::uint32_t material) {
                                        const glm::vec3& e = scene.materials[material].emission;
                                        return e.x > 0.0f || e.y > 0.0f || e.z > 0.0f;
                                      });
  return {"direct light of the map", true,
          fmt::format("shadow rays from every texel to {} punctual lights{}", scene.lights.size(),
                      emitters > 0 ? fmt::format(" and {} emissive triangles", emitters)
                                   : ", of which one each is exact")};
}

}  // namespace

LightMapRequest lightMapRequest(const BakeRequest& request) {
  LightMapRequest layout;
  layout.texelSize = request.lightMapTexel;
  return layout;
}

std::vector<PlannedPass> planLightMap(const CompiledScene& scene, const BakeRequest& request) {
  const char *name = "light map", *direct = "direct light of the map";
  const char* sky = "sky light of the map";
  if (!request.lightMap)
    return {{name, false, "not asked for"},
            {direct, false, "no light map is asked for"},
            {sky, false, "no light map is asked for"}};
  if (!(litArea(scene) > 0.0)) {
    const char* reason = "no surface reflects diffusely, so none needs light";
    return {{name, false, reason}, {direct, false, reason}, {sky, false, reason}};
  }
  return {{name, true, texelText(scene, request) + "; charts of surfaces without creases, seams stitched"},
          planDirect(scene),
          request.radiosityShape.environment
              ? PlannedPass{sky, true, "rays by the cosine and by the sky's radiance from every texel"}
              : PlannedPass{sky, false, "there is no sky (--env)"}};
}

std::uint64_t lightMapBytes(const CompiledScene& scene, const BakeRequest& request) {
  return static_cast<std::uint64_t>(1.3 * texelCount(scene, request)) * bytesPerTexel +
         scene.triangleCount() * bytesPerTriangle;
}

}  // namespace prelight
