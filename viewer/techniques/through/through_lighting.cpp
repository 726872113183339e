#include "viewer/techniques/through/through_lighting.h"

#include <utility>

namespace prelight::viewer {

ThroughLighting::ThroughLighting(std::unique_ptr<DrawnTransfer> fronts,
                                 std::unique_ptr<DrawnTransfer> through)
    : fronts_(std::move(fronts)), through_(std::move(through)) {}

void ThroughLighting::light(const Illumination& light) {
  fronts_->light(light);
  through_->light(light);
}

bool ThroughLighting::verticesMoved() {
  const bool fronts = fronts_->verticesMoved(), through = through_->verticesMoved();
  return fronts || through;
}

void ThroughLighting::bind(const gl::Program& program) const {
  fronts_->bind(program);
  through_->bind(program);
  program.set("knowsThrough", 1);
}

void ThroughLighting::describe(const Illumination& light, Warnings& notes) const {
  fronts_->describe(light, notes);
}

}  // namespace prelight::viewer
