#pragma once

#include <optional>
#include <string>
#include <vector>

#include "prelight/scene.h"

namespace prelight::viewer {

/// An animation that can be played.
struct PlayedAnimation {
  std::size_t animation = 0;  ///< into Scene::animations
  std::string name;
  double start = 0.0;  ///< s, of its first key
  double end = 0.0;    ///< of its last, after the first
};

/// Where a window stands in the animations of its scene, and how it goes on.
class Playback {
 public:
  static constexpr double longestStep = 0.1;     ///< s; slower frames play slower, and skip nothing
  static constexpr double frame = 1.0 / 24.0;    ///< s, of a single step
  static constexpr double greatestSpeed = 16.0;  ///< in either direction

  /// Nothing to play.
  Playback() = default;
  /// The scene's animations that have a duration. The first moment is that of `shown`.
  explicit Playback(const Scene& scene);

  bool exists() const { return !animations_.empty(); }
  const std::vector<PlayedAnimation>& animations() const { return animations_; }
  std::size_t chosen() const { return chosen_; }  ///< into animations()

  /// The moment that is shown; none: the scene as it was given.
  std::optional<SceneMoment> moment() const;
  double seconds() const { return seconds_.value_or(start()); }
  double start() const { return exists() ? animations_[chosen_].start : 0.0; }
  double end() const { return exists() ? animations_[chosen_].end : 0.0; }
  bool plays() const { return plays_; }
  double speed() const { return speed_; }
  bool loops() const { return loops_; }

  /// Another animation, from its start.
  void choose(std::size_t which);
  /// One of Scene::animations; nothing changes where it does not last.
  void chooseAnimation(std::size_t animation);
  void toggle();
  void seek(double seconds);     ///< within the animation
  void step(int frames);         ///< and pauses
  void setSpeed(double factor);  ///< below 0: backwards
  void setLoop(bool loop) { loops_ = loop; }

  /// Plays on by a time that has passed, longestStep at most. Without a loop it ends at the end.
  void advance(double passed);

 private:
  bool isAtEnd() const;

  std::vector<PlayedAnimation> animations_;
  std::size_t chosen_ = 0;
  std::optional<double> seconds_;  ///< none: not played yet
  bool plays_ = false;
  double speed_ = 1.0;
  bool loops_ = true;
};

}  // namespace prelight::viewer
