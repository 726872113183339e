#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "cli/session.h"

namespace prelight::cli {

/// A glTF file that is put into a scene.
struct PlacedObject {
  std::filesystem::path file;
  glm::dvec3 at{0.0};       ///< m, where the file's origin goes, world space
  double yawDegrees = 0.0;  ///< counter-clockwise seen from above
  double scale = 1.0;

  glm::dmat4 transform() const;
};

/// "FILE:x,y,z[:yaw[:scale]]"; the file's name may have colons. Throws UsageError.
PlacedObject parsePlacedObject(const std::string& text);

/// --object.
void addObjectOption(CLI::App& app, std::vector<PlacedObject>& objects, const std::string& help);

/// An object as it was added to a scene.
struct AddedObject {
  int node = 0;       ///< its number in the scene
  LoadedScene alone;  ///< where it stands, without the scene
};

/// Loads objects and adds them to a scene, which is not compiled anew.
std::vector<AddedObject> addObjects(Session& session, const std::vector<PlacedObject>& objects, Scene& scene);

}  // namespace prelight::cli
