#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scene/gltf/json_cursor.h"

namespace prelight {

// Access to a JSON tree of any shape, without errors.

/// Returns a member of an object, or null where there is none.
inline const nlohmann::ordered_json& part(const nlohmann::ordered_json& object, std::string_view key) {
  static const nlohmann::ordered_json none;
  if (!object.is_object()) return none;
  const auto found = object.find(std::string(key));
  return found == object.end() ? none : *found;
}

/// Returns an element of an array, or null where there is none.
inline const nlohmann::ordered_json& partAt(const nlohmann::ordered_json& list, std::size_t index) {
  static const nlohmann::ordered_json none;
  return list.is_array() && index < list.size() ? list[index] : none;
}

/// Returns the element to which a reference refers, or null where there is none.
inline const nlohmann::ordered_json& partAt(const nlohmann::ordered_json& list,
                                            const nlohmann::ordered_json& reference) {
  static const nlohmann::ordered_json none;
  const auto index = unsignedValue(reference);
  return index ? partAt(list, static_cast<std::size_t>(*index)) : none;
}

inline double numberOf(const nlohmann::ordered_json& value, double fallback) {
  return value.is_number() ? value.get<double>() : fallback;
}

/// Calls visit(part, JSON path) for the elements of the root's member `list`.
template <class Visit>
void forEachPart(const nlohmann::ordered_json& root, const char* list, Visit visit) {
  const nlohmann::ordered_json& parts = part(root, list);
  if (!parts.is_array()) return;
  for (std::size_t i = 0; i < parts.size(); ++i) visit(parts[i], fmt::format("/{}/{}", list, i));
}

}  // namespace prelight
