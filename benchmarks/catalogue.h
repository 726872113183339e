#pragma once

#include <memory>
#include <string>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Returns every suite of this build; those that need OpenGL come last.
std::vector<std::unique_ptr<Suite>> makeSuites();

/// A part of a suite.
struct ChosenPart {
  Suite* suite = nullptr;
  std::string part;
};

/// Returns the parts that a name chooses: all parts of the suite of that name, or the part of that name, or
/// all parts if the name is empty. Returns nothing for an unknown name.
std::vector<ChosenPart> partsNamed(const std::string& name,
                                   const std::vector<std::unique_ptr<Suite>>& suites);

/// Returns the names of suites and parts, each once.
std::vector<std::string> knownNames(const std::vector<std::unique_ptr<Suite>>& suites);

}  // namespace prelight::benchmarks
