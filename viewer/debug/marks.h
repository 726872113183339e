#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "viewer/debug/debug_drawing.h"

namespace prelight::viewer {

/// A point, or an end of a line.
struct Mark {
  glm::vec3 position{0.0f};  ///< scene coordinates
  glm::vec3 color{1.0f};     ///< as displayed at exposure 1, linear
};

/// Points and lines over a picture.
struct Marks {
  std::vector<Mark> points;
  std::vector<Mark> lines;    ///< two ends each
  float pointSize = 3.0f;     ///< pixels
  float lineWidth = 1.3f;     ///< pixels
  bool shineThrough = false;  ///< parts behind surfaces are shown faintly
  std::string legend;

  void addLine(const glm::vec3& from, const glm::vec3& to, const glm::vec3& color) {
    lines.push_back({from, color});
    lines.push_back({to, color});
  }

  /// Adds the twelve edges of an axis-aligned box.
  void addBox(const glm::vec3& lower, const glm::vec3& upper, const glm::vec3& color);
};

/// Returns the drawing of marks, over the picture dimmed to a third.
std::unique_ptr<DebugDrawing> drawMarks(Marks marks, const CompiledScene& scene);

}  // namespace prelight::viewer
