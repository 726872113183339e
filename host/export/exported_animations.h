#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace prelight {

/// JSON pointers to the copies of an object that animations may move and the export has several times.
struct AnimatedCopies {
  std::string from;             ///< pointer to the original, such as "/materials/3"
  std::vector<std::string> to;  ///< pointers to the copies, such as "/materials/7"
  bool moved = false;           ///< whether the original is no longer at `from`
};

/// Adds a channel for each copy to channels that animate an object. Channels of core glTF count as pointers
/// "/nodes/N/PATH".
void animateCopies(nlohmann::ordered_json& root, const std::vector<AnimatedCopies>& copies);

/// Removes channels whose pointer `gone` reports as removed, and animations that are left without channels,
/// which glTF does not permit.
void dropChannels(nlohmann::ordered_json& root, const std::function<bool(const std::string& pointer)>& gone);

}  // namespace prelight
