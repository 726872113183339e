#pragma once

#include <filesystem>
#include <string>

#include "export/export_bake.h"
#include "gi/probes/irradiance_volume.h"
#include "prelight/transfer.h"

namespace prelight {

/// Writes an irradiance volume into a folder: NAME.probes.bin, its description NAME.probes.json, a README
/// and, for three.js, a loader. All files appear together.
ExportReport exportProbes(const IrradianceVolume& volume, const std::filesystem::path& folder,
                          const std::string& name, const ExportRequest& request);

/// Writes a transfer volume into a folder: NAME.volume.bin and NAME.volume.json. All files appear together.
ExportReport exportTransferVolume(const VolumeTransfer& volume, const std::filesystem::path& folder,
                                  const std::string& name, const ExportRequest& request);

}  // namespace prelight
