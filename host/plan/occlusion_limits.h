#pragma once

namespace prelight {

/// Where rays begin and end, and how occlusion fades; metres, >= 0.
struct OcclusionLimits {
  double nearest = 0.0;     ///< what is nearer to a receiver occludes nothing
  double farthest = 0.0;    ///< what is farther occludes nothing; 0: no limit
  double obscurance = 0.0;  ///< occlusion fades out linearly up to this distance; 0: it does not
};

}  // namespace prelight
