#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "basis/sh.h"
#include "oracle/brute_force.h"
#include "support/devices.h"
#include "support/scenes.h"

// The error that a viewer sees: baked values, interpolated over triangles as a rasteriser does, are compared
// at random points of the surface with a double-precision Monte Carlo estimate that uses no acceleration
// structure. The estimate shares no code with the bake.
namespace prelight {
namespace {

struct Point {
  std::uint32_t triangle;
  double b[3];
  glm::dvec3 position, normal;
};

struct Truth {
  double ao = 0.0;
  std::vector<double> transfer;  ///< [i], one bounce, channel 0.
};

class SurfaceError : public ::testing::Test {
 protected:
  SurfaceError() : random_(11) {
    // A room without a ceiling, with a block in it: there are corners everywhere.
    scene_ = test::box(8, {-1, 0, -1}, {1, 1, 1}, true);
    const CompiledScene block = test::box(4, {-0.5f, 0.02f, -0.4f}, {0.2f, 0.6f, 0.3f}, false);
    std::vector<glm::uvec3> kept;
    for (const auto& t : scene_.triangles)
      if (scene_.positions[t.x].y + scene_.positions[t.y].y + scene_.positions[t.z].y < 2.99f)
        kept.push_back(t);
    scene_ = test::sceneOf(scene_.positions, kept, albedo);
    test::append(scene_, block);
    for (auto& material : scene_.materials) material.albedo = glm::vec3(albedo);
  }

  static constexpr float albedo = 0.7f;

  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  glm::dvec3 cosineDirection(const glm::dvec3& n) {
    // A uniform point on the unit sphere plus the normal has a cosine-weighted direction.
    for (;;) {
      const glm::dvec3 d = glm::dvec3(test::randomDirection(random_)) + n;
      if (glm::length(d) > 1e-4) return glm::normalize(d);
    }
  }

  Point samplePoint(const std::discrete_distribution<std::uint32_t>& byArea) {
    auto distribution = byArea;
    Point p{};
    p.triangle = distribution(random_);
    const double root = std::sqrt(uniform()), v = uniform();
    p.b[0] = 1.0 - root;
    p.b[1] = root * (1.0 - v);
    p.b[2] = root * v;
    const auto& t = scene_.triangles[p.triangle];
    for (int k = 0; k < 3; ++k) p.position += p.b[k] * glm::dvec3(scene_.positions[t[k]]);
    p.normal = glm::normalize(geometricNormal(scene_, p.triangle));
    return p;
  }

  Truth truthAt(const Point& p, int order, int rays) {
    Truth truth;
    truth.transfer.assign(static_cast<std::size_t>(order * order), 0.0);
    std::vector<double> y(truth.transfer.size());
    for (int i = 0; i < rays; ++i) {
      glm::dvec3 position = p.position, normal = p.normal;
      std::uint32_t source = p.triangle;
      double throughput = 1.0;
      for (int bounce = 0; bounce <= 1; ++bounce) {
        const glm::dvec3 direction = cosineDirection(normal);
        const auto hit = reference::closestHit(scene_, position, direction, 1e30, source);
        if (!hit) {
          if (bounce == 0) truth.ao += 1.0 / rays;
          sh::evaluate(direction, order, y);
          for (std::size_t k = 0; k < y.size(); ++k) truth.transfer[k] += throughput * y[k] / rays;
          break;
        }
        throughput *= albedo;
        source = hit->triangle;
        position += hit->t * direction;
        normal = glm::normalize(geometricNormal(scene_, source));
        if (glm::dot(normal, direction) > 0.0) normal = -normal;
      }
    }
    return truth;
  }

  std::discrete_distribution<std::uint32_t> byArea() const {
    std::vector<double> areas;
    for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t)
      areas.push_back(glm::length(geometricNormal(scene_, t)));
    return {areas.begin(), areas.end()};
  }

  CompiledScene scene_;
  std::mt19937 random_;
};

TEST_F(SurfaceError, InterpolatedBake_BeatsExactValuesAtVertices) {
  BakeRequest request;
  request.ao = true;
  request.sh.order = 3;
  request.bounces = 1;
  request.effort.rays = 2048;
  Progress progress;
  BakeReport report;
  const Bake bake =
      bakeScene(scene_, request, makePlan(Scene(), scene_, request), test::sharedDevice(), progress, report);

  // The naive bake takes the true value at each vertex itself, a little off the surface.
  std::vector<double> naive(scene_.vertexCount(), 1.0);
  for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = scene_.triangles[t][k];
      Point p{0xffffffffu, {}, glm::dvec3(scene_.positions[v]), glm::dvec3(scene_.normals[v])};
      p.position += 1e-5 * p.normal;
      if (naive[v] == 1.0) naive[v] = truthAt(p, 1, 256).ao;
    }

  const auto area = byArea();
  constexpr int points = 250, rays = 1024;
  double aoError = 0.0, naiveError = 0.0, shError = 0.0, shNorm = 0.0;
  for (int i = 0; i < points; ++i) {
    const Point p = samplePoint(area);
    const Truth truth = truthAt(p, 3, rays);
    double ao = 0.0, atVertices = 0.0;
    std::vector<double> transfer(9, 0.0);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = scene_.triangles[p.triangle][k];
      ao += p.b[k] * bake.ao[v];
      atVertices += p.b[k] * naive[v];
      for (std::size_t c = 0; c < 9; ++c) transfer[c] += p.b[k] * bake.sh->coefficients[v * 27 + c];
    }
    aoError += (ao - truth.ao) * (ao - truth.ao) / points;
    naiveError += (atVertices - truth.ao) * (atVertices - truth.ao) / points;
    for (std::size_t c = 0; c < 9; ++c) {
      shError += (transfer[c] - truth.transfer[c]) * (transfer[c] - truth.transfer[c]) / points;
      shNorm += truth.transfer[c] * truth.transfer[c] / points;
    }
  }
  // The reference estimate has noise of about 0.014 here.
  EXPECT_LT(std::sqrt(aoError), 0.03);
  EXPECT_LT(std::sqrt(aoError), 0.5 * std::sqrt(naiveError)) << "naive " << std::sqrt(naiveError);
  EXPECT_LT(std::sqrt(shError / shNorm), 0.12);
  RecordProperty("aoRms", std::to_string(std::sqrt(aoError)));
  RecordProperty("naiveRms", std::to_string(std::sqrt(naiveError)));
  RecordProperty("shRelativeRms", std::to_string(std::sqrt(shError / shNorm)));
}

}  // namespace
}  // namespace prelight
