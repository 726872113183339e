#include "photon/photon_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/directions.h"
#include "base/parallel.h"
#include "photon/leaf_tree.h"
#include "prelight/error.h"

namespace prelight {

namespace {

using device::LeafTree;
using device::Photon;
using device::PhotonBlock;

constexpr std::size_t grain = 1u << 14;  // photons
constexpr float farOff = 1e30f;          // m; its square is infinite

bool isSound(const Photon& photon, std::size_t triangleCount) {
  bool sound = photon.triangle < triangleCount;
  for (int k = 0; k < 3; ++k)
    sound = sound && std::isfinite(photon.position[k]) && std::isfinite(photon.power[k]) &&
            photon.power[k] >= 0.0f;
  return sound;
}

[[noreturn]] void reject(std::span<const Photon> photons, std::size_t i, std::size_t triangleCount) {
  const Photon& p = photons[i];
  throw InputError(
      fmt::format("photon {}", i),
      fmt::format("position ({}, {}, {}), power ({}, {}, {}) W, triangle {}; expected finite numbers, no "
                  "negative power and a triangle below {}",
                  p.position[0], p.position[1], p.position[2], p.power[0], p.power[1], p.power[2], p.triangle,
                  triangleCount));
}

std::vector<TreeRange> rangesOf(std::span<const std::uint32_t> mapOf, std::size_t mapCount) {
  std::vector<TreeRange> ranges(mapCount);
  for (const std::uint32_t map : mapOf) ++ranges[map].count;
  std::size_t first = 0;
  for (TreeRange& range : ranges) {
    range.first = first;
    first += range.count;
  }
  return ranges;
}

Box fillBlock(std::span<const Photon> photons, std::span<const TreeItem> items, PhotonBlock& block) {
  Box box;
  for (std::size_t i = 0; i < PRELIGHT_BLOCK_PHOTONS; ++i) {
    const Photon photon =
        i < items.size() ? photons[items[i].index] : Photon{{farOff, farOff, farOff}, 0, {}, 0};
    if (i < items.size()) box.grow(items[i].position);
    block.x[i] = photon.position[0];
    block.y[i] = photon.position[1];
    block.z[i] = photon.position[2];
    block.triangle[i] = photon.triangle;
    block.red[i] = photon.power[0];
    block.green[i] = photon.power[1];
    block.blue[i] = photon.power[2];
    block.direction[i] = photon.direction;
  }
  return box;
}

}  // namespace

std::vector<std::uint32_t> mapsOfPhotons(std::span<const Photon> photons, const DensitySurface& surface) {
  std::vector<std::uint32_t> mapOf(photons.size());
  std::atomic<std::size_t> unsound = photons.size();
  parallelRanges(photons.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!isSound(photons[i], surface.places.size())) {
        for (std::size_t seen = unsound; i < seen && !unsound.compare_exchange_weak(seen, i);) {
        }
        return;
      }
      const device::SurfacePlace& place = surface.places[photons[i].triangle];
      const float* n = surface.triangles[place.areaTriangle].normal;
      const glm::dvec3 from = unpackDirection(photons[i].direction);
      const bool back = from.x * n[0] + from.y * n[1] + from.z * n[2] < 0.0;
      mapOf[i] = 2u * (place.region & ~PRELIGHT_PLANAR_REGION) + (back ? 1u : 0u);
    }
  });
  if (unsound < photons.size()) reject(photons, unsound, surface.places.size());
  return mapOf;
}

PhotonMaps makePhotonMaps(std::span<const Photon> photons, const DensitySurface& surface) {
  return makePhotonMaps(photons, mapsOfPhotons(photons, surface), surface.regionCount());
}

PhotonMaps makePhotonMaps(std::span<const Photon> photons, std::span<const std::uint32_t> mapOf,
                          std::size_t patches) {
  const std::vector<TreeRange> ranges = rangesOf(mapOf, 2 * patches);
  std::vector<TreeItem> items(photons.size());
  std::vector<std::size_t> next;
  for (const TreeRange& range : ranges) next.push_back(range.first);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const float* p = photons[i].position;
    items[next[mapOf[i]]++] = {{p[0], p[1], p[2]}, static_cast<std::uint32_t>(i)};
  }

  const LeafTrees trees = makeLeafTrees(items, ranges, PRELIGHT_BLOCK_PHOTONS);
  PhotonMaps maps;
  maps.trees = trees.trees;
  maps.photonCount = photons.size();
  maps.blocks.resize(trees.leafCount);
  std::vector<Box> leaves(trees.leafCount);
  for (std::size_t t = 0; t < ranges.size(); ++t) {
    const LeafTree& tree = trees.trees[t];
    if (tree.count == 0) continue;
    const auto own = std::span<const TreeItem>(items).subspan(ranges[t].first, ranges[t].count);
    parallelRanges(std::size_t{1} << tree.levels, 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t leaf = begin; leaf < end; ++leaf) {
        const std::size_t first = leafBegin(tree, leaf), last = leafBegin(tree, leaf + 1);
        leaves[tree.firstLeaf + leaf] =
            fillBlock(photons, own.subspan(first, last - first), maps.blocks[tree.firstLeaf + leaf]);
      }
    });
  }
  const std::vector<Box> boxes = boxesOfNodes(trees, leaves);
  maps.boxes.reserve(6 * boxes.size());
  for (const Box& box : boxes)
    for (const glm::vec3& corner : {box.lower, box.upper})
      for (int k = 0; k < 3; ++k) maps.boxes.push_back(corner[k]);
  return maps;
}

}  // namespace prelight
