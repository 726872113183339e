#pragma once

#include <filesystem>
#include <string>

namespace prelight::benchmarks {

/// A folder of its own below the system's temporary one, which goes with all that is in it.
class WorkFolder {
 public:
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace prelight::benchmarks
