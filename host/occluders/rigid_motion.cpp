#include "occluders/rigid_motion.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace prelight {

namespace {

Eigen::Matrix3Xd matrixOf(std::span<const glm::vec3> places) {
  Eigen::Matrix3Xd matrix(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i)
    matrix.col(static_cast<Eigen::Index>(i)) << places[i].x, places[i].y, places[i].z;
  return matrix;
}

}  // namespace

RigidFit fitMotion(std::span<const glm::vec3> from, std::span<const glm::vec3> to) {
  RigidFit fit;
  if (std::equal(from.begin(), from.end(), to.begin(), to.end())) return fit;
  const Eigen::Matrix4d best = Eigen::umeyama(matrixOf(from), matrixOf(to), false);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) fit.motion.rotation[column][row] = best(row, column);
  fit.motion.translation = {best(0, 3), best(1, 3), best(2, 3)};
  for (std::size_t i = 0; i < from.size(); ++i)
    fit.deviation =
        std::max(fit.deviation, glm::distance(fit.motion.point(glm::dvec3(from[i])), glm::dvec3(to[i])));
  return fit;
}

}  // namespace prelight
