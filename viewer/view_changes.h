#pragma once

#include <algorithm>
#include <vector>

#include "viewer/light_follower.h"

namespace prelight::viewer {

/// Tells light that is live of what is dragged and turned in a window.
template <typename Live>
class ViewChanges {
 public:
  /// Lights that the window has added are not the scene's: they shine directly alone.
  void tell(const FollowedView& view, Live& live) {
    for (std::size_t i = 0; i < view.shifts.size(); ++i) {
      const glm::dvec3 before = i < shifts_.size() ? shifts_[i].by : glm::dvec3(0.0);
      if (view.shifts[i].by != before)
        live.moveNode(view.shifts[i].node, {glm::dmat3(1.0), view.shifts[i].by});
    }
    shifts_.assign(view.shifts.begin(), view.shifts.end());
    // Where the window has them, also those that hang on nodes that have moved.
    const std::size_t known = live.scene().compiled().lights.size();
    for (std::size_t i = 0; i < std::min(view.lights.size(), known); ++i)
      if (!shinesAs(view.lights[i], live.scene().compiled().lights[i])) live.setLight(i, view.lights[i]);
    if (view.skyRotation != live.skyRotation()) live.setSkyRotation(view.skyRotation);
  }

 private:
  std::vector<NodeShift> shifts_;  ///< that it knows of
};

}  // namespace prelight::viewer
