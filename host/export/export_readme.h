#pragma once

#include <string>
#include <vector>

#include "export/export_request.h"

namespace prelight {

struct ExportReport;

/// A text beside an exported scene.
struct TextFile {
  std::string name;
  std::string contents;  ///< for people
  std::string text;
};

/// A README with what the target needs to know, and a program that loads the scene where it needs one.
std::vector<TextFile> exportTexts(const std::string& name, const ExportReport& report,
                                  const ExportRequest& request);

/// The same of what is of points in the air.
std::vector<TextFile> volumeTexts(const std::string& name, const ExportReport& report,
                                  const ExportRequest& request);

}  // namespace prelight
