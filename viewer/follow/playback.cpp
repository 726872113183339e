#include "viewer/follow/playback.h"

#include <algorithm>
#include <cmath>

namespace prelight::viewer {

Playback::Playback(const Scene& scene) {
  for (std::size_t i = 0; i < scene.animations.size(); ++i) {
    const Animation& animation = scene.animations[i];
    const double start = animation.startTime(), end = animation.endTime();
    if (!(end > start)) continue;
    const std::string name = animation.name.empty() ? "animation " + std::to_string(i) : animation.name;
    animations_.push_back({i, name, start, end});
  }
  if (!scene.moment) return;
  chooseAnimation(scene.moment->animation);
  if (exists() && animations_[chosen_].animation == scene.moment->animation) seconds_ = scene.moment->seconds;
}

std::optional<SceneMoment> Playback::moment() const {
  if (!exists() || !seconds_) return std::nullopt;
  return SceneMoment{animations_[chosen_].animation, *seconds_};
}

void Playback::choose(std::size_t which) {
  if (which >= animations_.size() || which == chosen_) return;
  chosen_ = which;
  seconds_ = start();
}

void Playback::chooseAnimation(std::size_t animation) {
  for (std::size_t i = 0; i < animations_.size(); ++i)
    if (animations_[i].animation == animation) chosen_ = i;
}

bool Playback::isAtEnd() const { return speed_ < 0.0 ? seconds() <= start() : seconds() >= end(); }

void Playback::toggle() {
  if (!exists()) return;
  plays_ = !plays_;
  if (!seconds_) seconds_ = start();
  if (plays_ && !loops_ && isAtEnd()) seconds_ = speed_ < 0.0 ? end() : start();
}

void Playback::seek(double seconds) {
  if (exists()) seconds_ = std::clamp(seconds, start(), end());
}

void Playback::step(int frames) {
  plays_ = false;
  seek(seconds() + frames * frame);
}

void Playback::setSpeed(double factor) {
  if (std::isfinite(factor)) speed_ = std::clamp(factor, -greatestSpeed, greatestSpeed);
}

void Playback::advance(double passed) {
  if (!plays_ || !exists()) return;
  const double length = end() - start();
  const double next = seconds() + speed_ * std::clamp(passed, 0.0, longestStep);
  if (next >= start() && next <= end()) {
    seconds_ = next;
  } else if (loops_) {
    const double past = std::fmod(next - start(), length);
    seconds_ = start() + (past < 0.0 ? past + length : past);
  } else {
    plays_ = false;
    seek(next);
  }
}

}  // namespace prelight::viewer
