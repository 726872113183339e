#pragma once

namespace prelight {

/// Share of a cosine-weighted sky that a ball hides (Howell, catalogue of configuration factors, differential
/// element to sphere; part of it may lie below the horizon). `cosine`: of the element's normal and the
/// direction of the centre; `sine`: radius over distance of the centre, in [0,1). In [0,1].
double ballFormFactor(double cosine, double sine);

}  // namespace prelight
