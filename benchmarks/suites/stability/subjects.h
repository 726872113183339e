#pragma once

#include <string>
#include <vector>

#include "benchmarks/suites/stability/trials.h"

namespace prelight::benchmarks::stability {

enum class SubjectKind : std::uint8_t { Basis, Kernel, Pipeline };

/// Something whose errors are measured.
struct Subject {
  std::string name;
  SubjectKind kind = SubjectKind::Kernel;
  std::string truth;  ///< the values that it is compared with
  std::string scale;  ///< the size that errors are relative to
  std::string rests;  ///< why the bound is what it is
  std::vector<std::string>
      kernels;  ///< kernels that it runs: "lab/kernels/sh_evaluate_kernels.cl:evaluateSh"
  void (*run)(Trials&) = nullptr;
};

/// Every subject. Together they run every kernel.
const std::vector<Subject>& subjects();

}  // namespace prelight::benchmarks::stability
