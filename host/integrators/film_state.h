#pragma once

#include <algorithm>
#include <cmath>

#include "base/state_file.h"
#include "integrators/film.h"
#include "integrators/reference.h"

namespace prelight::reference {

/// Returns the key of everything that a picture's bytes depend on, part by part.
StateKey filmKey(const ReferenceInputs& inputs, const ReferenceRequest& request, const DeviceInfo& device);

/// Writes an unfinished picture, or reads it into a film of the same size with the same parts.
template <typename State>
void exchangeFilm(State& state, Film& film) {
  state.value(film.passes);
  state.value(film.blockPixels);
  state.require(film.blockPixels < film.pixelCount() && film.passes <= ReferenceRequest::maxSamples);
  for (std::vector<glm::dvec3>* colors : {&film.sums, &film.parts}) {
    state.sameSize(*colors);
    state.check([&] {
      return std::all_of(colors->begin(), colors->end(),
                         [](const glm::dvec3& color) { return std::isfinite(color.x + color.y + color.z); });
    });
  }
  for (std::vector<double>* numbers : {&film.means, &film.squares, &film.blurs, &film.blurSquares}) {
    state.sameSize(*numbers);
    state.requireFinite(*numbers);
  }
  state.check([&] {
    return std::all_of(film.squares.begin(), film.squares.end(), [](double s) { return s >= 0.0; });
  });
}

}  // namespace prelight::reference
