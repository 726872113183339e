#include "benchmarks/run/run_options.h"

namespace prelight::benchmarks {

RunOptions RunOptions::quickRun() {
  RunOptions options;
  options.quick = true;
  options.runs = 1;
  options.suiteSeconds = 60.0;
  return options;
}

nlohmann::ordered_json RunOptions::toJson() const {
  std::vector<std::string> names;
  for (const std::filesystem::path& sky : skies) names.push_back(sky.filename().string());
  return {{"quick", quick},
          {"runs", runs},
          {"onlyCase", onlyCase},
          {"suiteSeconds", suiteSeconds},
          {"skies", names}};
}

}  // namespace prelight::benchmarks
