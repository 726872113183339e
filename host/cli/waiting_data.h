#pragma once

#include <optional>

#include "base/spill_file.h"
#include "plan/file_use.h"
#include "scene/gltf/gltf_document.h"

namespace prelight::cli {

/// Keeps a file's binary data in a temporary file during a bake that does not read them (fileWaits()).
class WaitingData {
 public:
  /// `document` must outlive the object.
  WaitingData(const BakeRequest& request, GltfDocument& document)
      : document_(document), size_(document.bin.size()) {
    if (!fileWaits(request, size_)) return;
    file_.emplace();
    file_->write(0, std::as_bytes(std::span(document.bin)));
    document.bin = std::vector<std::uint8_t>();  // {} would keep the memory
  }

  /// Reads the data back.
  void fetch() {
    if (!file_) return;
    document_.bin.resize(size_);
    file_->read(0, std::as_writable_bytes(std::span(document_.bin)));
    file_.reset();
  }

 private:
  GltfDocument& document_;
  std::size_t size_;
  std::optional<SpillFile> file_;
};

}  // namespace prelight::cli
