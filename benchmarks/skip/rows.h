#pragma once

#include <vector>

#include "benchmarks/skip/setting.h"

namespace prelight::benchmarks::skip {

/// Of what bakes of visibility and transfer leave out.
std::vector<Row> transferRows();

/// Of what light maps and radiosity leave out.
std::vector<Row> staticLightRows();

/// Of what pictures leave out, path-traced and with photons.
std::vector<Row> pictureRows();

/// All of them.
std::vector<Row> rows();

}  // namespace prelight::benchmarks::skip
