#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "encodings/encoding.h"

namespace prelight {

/// Spherical harmonics of order 2 or 3: the first bands of incident radiance itself, [coefficient][channel],
/// whose irradiance follows by the clamped cosine's zonal coefficients (Ramamoorthi and Hanrahan 2001).
Encoding shEncoding(int order);

/// Spherical harmonics of order 2, [coefficient][channel], interpreted per channel as an even sky over the
/// surface and one distant lamp, as light maps do with their directions (docs/notes/lightmaps.md, "Normal
/// maps").
Encoding skyAndLampEncoding();

/// Hemisphere lighting: two colours along the axis of the surface's own normal N, [N, -N][channel], mixed by
/// (1 + n.N) / 2. This is exact for an even sky over the surface, which a vertical axis in world space would
/// miss on walls.
Encoding hemisphereEncoding();

/// Trilight (Forsyth 2003): a direction, and the irradiance of normals along, across and against it,
/// [direction, along, across, against][3].
Encoding trilightEncoding();

/// Ambient cube (McTaggart 2004): irradiance along the six directions +x, -x, +y, -y, +z, -z of the world,
/// [direction][channel], each weighted by the square of the normal's component.
Encoding ambientCubeEncoding();

/// Lobes exp(sharpness (v.d - 1)) with fixed directions d and one sharpness.
struct GaussianLobes {
  std::vector<glm::vec3> directions;  ///< relative to the frame, over the hemisphere
  float sharpness = 0.0f;
  /// Irradiance of a lobe of radiance 1 as a polynomial in the cosine x between its direction and the normal:
  /// p0 + p1 x + p2 x^2 + p3 x^4 + p4 x^6 + p5 x^8.
  std::array<float, 6> irradiance{};
};

/// Returns a set of 6, 9, 12 or 24 lobes.
const GaussianLobes& gaussianLobes(std::size_t count);

/// Spherical Gaussians: radiance of each lobe, [lobe][channel], >= 0.
Encoding sphericalGaussiansEncoding(std::size_t count);

/// The six functions of the H-basis (Habel and Wimmer 2010), orthonormal over the hemisphere: 1 to 4 are of
/// degree 1 in the direction (relative to the frame), 5 and 6 of degree 2.
std::array<float, 6> hBasis(const glm::vec3& direction);

/// Irradiance in the first `functions` (4 or 6) functions, [function][channel].
Encoding hBasisEncoding(int functions);

/// ZH3 (Roughton et al. 2024): spherical harmonics of order 2, [coefficient][channel], and per [channel] the
/// coefficient of the quadratic zonal harmonic about the axis of the luminance's linear band.
Encoding zh3Encoding();

/// ZH3 without the stored zonal coefficient K, which follows from the lower bands: K = F r (0.08 + 0.6 r) for
/// a constant coefficient F and a linear part r F along the axis.
Encoding zh3HallucinatedEncoding();

/// One to three lamps in the dominant directions, and the remaining light as a hemisphere of two colours
/// about the surface's normal: [directions, above, below, lamps][3].
Encoding dominantDirectionEncoding(std::size_t lamps);

/// Ambient, highlight and direction: ambient light and one lamp, [direction, ambient, highlight][3].
/// Irradiance is ambient + highlight max(n.d, 0).
Encoding ahdEncoding();

/// Radiosity normal mapping (McTaggart 2004), the basis of Half-Life 2: irradiance along three orthogonal
/// vectors over the surface, [vector][channel], weighted by the squared cosines to the normal, normalised to
/// a sum of 1.
Encoding halfLife2Encoding();

}  // namespace prelight
