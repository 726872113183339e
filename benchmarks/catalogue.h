#pragma once

#include <memory>
#include <string>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Every suite of this build, those that need OpenGL last.
std::vector<std::unique_ptr<Suite>> makeSuites();

/// A part of a suite.
struct ChosenPart {
  Suite* suite = nullptr;
  std::string part;
};

/// The parts that a name chooses: those of the suite of that name, or the part of that name; all of them
/// where it is empty. Empty where nothing has the name.
std::vector<ChosenPart> partsNamed(const std::string& name,
                                   const std::vector<std::unique_ptr<Suite>>& suites);

/// Names of suites and of parts, each once.
std::vector<std::string> knownNames(const std::vector<std::unique_ptr<Suite>>& suites);

}  // namespace prelight::benchmarks
