#include "techniques/sh/bent_transfer.h"

#include <algorithm>
#include <span>

#include "base/parallel.h"
#include "basis/sh_rotation.h"
#include "basis/sh_zonal.h"
#include "techniques/sh/vertex_turns.h"

namespace prelight {

namespace {

constexpr std::size_t verticesPerRange = 256;
constexpr double negligibleTurn = 1e-9;

std::span<float> rowOf(HarmonicTransfer& transfer, std::size_t vertex) {
  const auto width = static_cast<std::size_t>(transfer.channels * transfer.order * transfer.order);
  return std::span(transfer.coefficients).subspan(vertex * width, width);
}

/// Adds what the open surface of a vertex gains by its bend, to all channels of its row.
void addOpenChange(const SurfaceBend& bend, std::size_t vertex, int order, std::span<float> row) {
  const auto width = static_cast<std::size_t>(order * order);
  const glm::dvec3 normal(bend.normals[vertex]);
  std::vector<double> stayed(width), turned(width), open(width);
  sh::openTransfer(normal, order, stayed);
  sh::openTransfer(bend.turns[vertex] * normal, order, turned);
  sh::openTransfer(glm::dvec3(bend.bentNormals[vertex]), order, open);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::size_t k = i % width;
    row[i] += static_cast<float>(open[k] - 0.5 * (stayed[k] + turned[k]));
  }
}

}  // namespace

SurfaceBend bendBetween(const CompiledScene& from, const CompiledScene& to) {
  SurfaceBend bend{vertexTurns(from, to), from.normals, to.normals, {}};
  bend.changed.resize(bend.turns.size());
  for (std::size_t v = 0; v < bend.turns.size(); ++v)
    bend.changed[v] = from.normals[v] != to.normals[v] ||
                      greatestDifference(bend.turns[v], glm::dmat3(1.0)) > negligibleTurn;
  return bend;
}

HarmonicTransfer halfTurned(const HarmonicTransfer& functions, const SurfaceBend& bend) {
  HarmonicTransfer result = functions;
  parallelRanges(bend.turns.size(), verticesPerRange, [&](std::size_t begin, std::size_t end) {
    std::vector<float> turned;
    for (std::size_t v = begin; v < end; ++v) {
      if (!bend.changed[v]) continue;
      const std::span<float> row = rowOf(result, v);
      turned.assign(row.begin(), row.end());
      sh::ShRotation(functions.order, bend.turns[v]).apply(std::span<const float>(row), std::span(turned));
      for (std::size_t i = 0; i < row.size(); ++i) row[i] = 0.5f * (row[i] + turned[i]);
    }
  });
  return result;
}

HarmonicTransfer bentTransfer(const HarmonicTransfer& transfer, const SurfaceBend& bend) {
  HarmonicTransfer result = halfTurned(transfer, bend);
  parallelRanges(bend.turns.size(), verticesPerRange, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      if (bend.changed[v]) addOpenChange(bend, v, transfer.order, rowOf(result, v));
  });
  return result;
}

}  // namespace prelight
