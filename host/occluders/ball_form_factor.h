#pragma once

namespace prelight {

/// Returns the share in [0,1] of a cosine-weighted hemisphere that a ball covers, where part of it may be
/// below the horizon (Howell, catalogue of configuration factors, differential element to sphere). `cosine`
/// is that between the element's normal and the direction of the centre; `sine` is radius over distance of
/// the centre, in [0,1).
double ballFormFactor(double cosine, double sine);

}  // namespace prelight
