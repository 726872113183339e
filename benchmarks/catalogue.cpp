#include "benchmarks/catalogue.h"

#include <algorithm>

#include "benchmarks/suites/bake/bake_suite.h"
#include "benchmarks/suites/indirect/indirect_suite.h"
#include "benchmarks/suites/live/live_suite.h"
#include "benchmarks/suites/pictures/pictures_suite.h"
#include "benchmarks/suites/relighting/relighting_suite.h"
#include "benchmarks/suites/skip/skip_suite.h"
#include "benchmarks/suites/stability/stability_suite.h"
#include "benchmarks/suites/techniques/techniques_suite.h"
#include "benchmarks/suites/tracing/tracing_suite.h"
#include "benchmarks/suites/transfer/transfer_suite.h"
#include "benchmarks/suites/viewer/viewer_suite.h"
#include "benchmarks/suites/visibility/visibility_suite.h"

namespace prelight::benchmarks {

std::vector<std::unique_ptr<Suite>> makeSuites() {
  std::vector<std::unique_ptr<Suite>> suites;
  for (const auto make : {tracingSuite, bakeSuite, picturesSuite, visibilitySuite, indirectSuite, liveSuite,
                          transferSuite, relightingSuite, stabilitySuite, skipSuite})
    suites.push_back(make());
#ifdef PRELIGHT_WITH_VIEWER
  suites.push_back(techniquesSuite());
  suites.push_back(viewerSuite());
#endif
  return suites;
}

std::vector<ChosenPart> partsNamed(const std::string& name,
                                   const std::vector<std::unique_ptr<Suite>>& suites) {
  std::vector<ChosenPart> chosen;
  for (const std::unique_ptr<Suite>& suite : suites)
    for (const Suite::Part& part : suite->parts())
      if (name.empty() || name == suite->name() || name == part.name)
        chosen.push_back({suite.get(), part.name});
  return chosen;
}

std::vector<std::string> knownNames(const std::vector<std::unique_ptr<Suite>>& suites) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const std::unique_ptr<Suite>& suite : suites) {
    add(suite->name());
    for (const Suite::Part& part : suite->parts()) add(part.name);
  }
  return names;
}

}  // namespace prelight::benchmarks
