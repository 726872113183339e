#pragma once

#include <memory>

#include "benchmarks/run/suite.h"
#include "benchmarks/suites/skip/rows.h"

namespace prelight::benchmarks {

/// Options of the suite `skip`; its table says what each means.
struct SkipOptions : RunOptions, skip::Effort {
  static const OptionTable<SkipOptions>& table();
};

/// Rays, launches, bytes and processor time of bakes and pictures with each feature absent, present but not
/// needed, and needed, and whether the first two give the same bits. Writes its table into options.folder.
void runSkip(const Device& device, const SkipOptions& options, SuiteRun& run);

/// Returns whether RunOptions::onlyCase leaves it a case.
bool hasSkipCase(const SkipOptions& options);

std::unique_ptr<Suite> skipSuite();

}  // namespace prelight::benchmarks
