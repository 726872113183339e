#pragma once

#include <string>
#include <vector>

#include "export/export_request.h"

namespace prelight {

struct ExportReport;

/// A text file that accompanies an exported scene.
struct TextFile {
  std::string name;
  std::string contents;  ///< description for messages
  std::string text;
};

/// Returns a README with the target's instructions, and a program that loads the scene if the target needs
/// one.
std::vector<TextFile> exportTexts(const std::string& name, const ExportReport& report,
                                  const ExportRequest& request);

/// Returns the README and program of an exported volume.
std::vector<TextFile> volumeTexts(const std::string& name, const ExportReport& report,
                                  const ExportRequest& request);

}  // namespace prelight
