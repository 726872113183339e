#pragma once

#include "benchmarks/run/measure.h"

namespace prelight::benchmarks {

/// Returns a bellied column on a ground, which five joints bend within 3 s: straight at 0 s and 3 s, to one
/// side at 1 s and to the other at 2 s.
BenchmarkScene bendingColumn();

}  // namespace prelight::benchmarks
