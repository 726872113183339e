#pragma once

#include <vector>

#include "benchmarks/suites/skip/setting.h"

namespace prelight::benchmarks::skip {

/// Rows of features that bakes of visibility and transfer can leave out.
std::vector<Row> transferRows();

/// Rows of features that light maps and radiosity can leave out.
std::vector<Row> staticLightRows();

/// Rows of features that pictures can leave out, path-traced and with photons.
std::vector<Row> pictureRows();

/// Every row.
std::vector<Row> rows();

}  // namespace prelight::benchmarks::skip
