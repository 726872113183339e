#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cast/hemisphere_column.h"
#include "cast/light_column.h"
#include "cast/scene_cast.h"
#include "cast/specular_column.h"
#include "cast/stored_transport.h"
#include "prelight/progress.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Transfer of the fit's slots in three channels. A channel's columns are order^2 of SH and then the groups
/// of lights.
struct SlotTransfer {
  int order = 0;
  std::uint32_t groups = 0;
  std::vector<float> total;      ///< [slot][3][column], with bounces
  std::vector<float> reflected;  ///< of it, what surfaces reflect: all but the last bounce; empty: not kept
  std::vector<float> backReflected;  ///< the same of the vertices' backs; empty: none is seen, or not kept
  int bounces = 0;                   ///< as asked for
  bool specular = false;             ///< light comes by mirrors and glass, too
  std::vector<float> through = {};   ///< [slot][3][column], what arrives on the backs of surfaces that let
                                     ///< light through, as `total` on fronts; 0 elsewhere; empty: not kept

  std::size_t shColumns() const { return static_cast<std::size_t>(order * order); }
  std::size_t columns() const { return shColumns() + groups; }

  /// Those that differ: where light comes straight from the sky alone, nothing colours it.
  int channels() const { return bounces > 0 || specular ? 3 : 1; }
};

/// Transfer without bounces of a slot's front in coefficient i of SH, the same in every channel. `fitted` is
/// the front's solution, relative to the baseline.
inline float directTransfer(const Baseline& baseline, std::span<const float> fitted, std::size_t slot,
                            std::size_t i) {
  const double relative = fitted[slot * baseline.columns() + 1 + i];
  return static_cast<float>(baseline.value(slot, 1 + i) + relative);
}

/// Columns of a cast whose light comes without bounces.
struct DirectColumns {
  const HemisphereColumn& hemisphere;
  const LightColumn* lights;       ///< nullptr: none
  const SpecularColumn* specular;  ///< nullptr: nothing has been followed
};

struct TransferRequest {
  int order = 0;           ///< at most that of the cast
  int bounces = 0;         ///< by stored transport
  bool reflected = false;  ///< keep what surfaces reflect, where there are bounces
  bool specular = false;   ///< the cast has followed rays from mirrors and glass
  bool through = false;    ///< keep what arrives on the backs, which the cast has looked from
};

/// Direct transfer from a cast that has run, and bounces of it. `fitted` is the front's solution.
/// `transport`: where there are bounces.
SlotTransfer makeTransfer(const FitMesh& mesh, const SceneCast& cast, const DirectColumns& direct,
                          StoredTransport* transport, const std::vector<float>& fitted,
                          const TransferRequest& request, Progress& progress,
                          std::vector<std::string>& notes);

/// What surfaces reflect, which has been kept, in the layout of the kernels: [vertex][3][columns], then,
/// where any is seen, the vertices' backs alike. Columns are the first `bands` of SH, at most shColumns(),
/// and the first `groups` of lights.
std::vector<float> sentTransfer(const FitMesh& mesh, const SlotTransfer& surface, std::size_t bands,
                                std::size_t groups = 0);

}  // namespace prelight
