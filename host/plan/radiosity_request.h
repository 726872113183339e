#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

namespace prelight {

struct Environment;

/// How the radiosity equation is solved; see radiosity/exchange_solver.h.
enum class RadiosityMethod : std::uint8_t { Jacobi, Chebyshev, GaussSeidel, Southwell };

constexpr std::array<std::string_view, 4> radiosityMethodNames = {"jacobi", "chebyshev", "gauss-seidel",
                                                                  "southwell"};

/// Irradiance of the scene's static lights at every vertex, by the radiosity equation. A bake's effort and
/// seed count too.
struct RadiosityRequest {
  bool wanted = false;
  double patchSize = 0.0;  ///< m, longest edge of an element at most; 0: from the scene's surface
  RadiosityMethod method = RadiosityMethod::GaussSeidel;
  double tolerance = 1e-4;                         ///< residual, of the direct light's power, in (0, 1)
  std::shared_ptr<const Environment> environment;  ///< nullptr: no sky
  double skyRotation = 0.0;                        ///< radians, counter-clockwise seen from above

  explicit operator bool() const { return wanted; }
};

}  // namespace prelight
