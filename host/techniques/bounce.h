#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cast/scene_cast.h"
#include "cast/stored_transport.h"
#include "prelight/progress.h"
#include "techniques/stored_rows.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Sends a part of the slots' transfer over the surface, [slot][partValues], and fits what the
/// slots receive of it through the stored rows.
class Bounce {
 public:
  /// `cast` has run. What is given outlives it.
  Bounce(const FitMesh& mesh, StoredTransport& transport, const SceneCast& cast);

  /// Uploads what surfaces send next. No backs: an empty vector.
  void send(const std::vector<float>& fronts, const std::vector<float>& backs);

  /// What has been sent, [vertex and then its back][partValues], to be sent again by another run.
  std::vector<float> sent() const;
  void sendAgain(const std::vector<float>& sent);
  std::size_t sentValues(bool backs) const {
    return mesh_.slotOfVertex.size() * transport_.partValues() * (backs ? 2 : 1);
  }

  /// What a side's slots receive of it. `firstValue` is the first of the part's values among [3][column].
  std::vector<float> receiveFronts(std::uint32_t firstValue, Progress& progress);
  std::vector<float> receiveBacks(std::uint32_t firstValue, Progress& progress);

 private:
  std::vector<float> receive(const StoredRows& rows, const SideCast& side, std::uint32_t firstValue,
                             Progress& progress);

  const FitMesh& mesh_;
  StoredTransport& transport_;
  const SceneCast& cast_;
  StoredRows fronts_;
  std::optional<StoredRows> backs_;  ///< made when backs receive
};

}  // namespace prelight
