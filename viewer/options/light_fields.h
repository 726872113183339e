#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace prelight::viewer {

/// The parts between colons of what `--light` takes. Functions throw UsageError, which names the faulty part
/// and shows examples.
class LightFields {
 public:
  explicit LightFields(std::string_view text);

  std::size_t count() const { return fields_.size(); }
  std::string_view operator[](std::size_t i) const { return fields_[i]; }

  /// Takes `word` out of the fields from `first` on; false where it is not there.
  bool takeWord(std::string_view word, std::size_t first);
  /// Takes a field NAME=VALUE out and returns its value; none where there is no such field.
  std::optional<std::string> takeValue(std::string_view name, std::size_t first);

  /// Fields after the first `names`.
  void expectFields(const std::string& kind, std::size_t names, std::size_t count) const;

  std::vector<double> numbers(std::string_view field, std::size_t count, const std::string& name) const;
  glm::dvec3 position(std::size_t i) const;
  glm::dvec3 direction(std::size_t i) const;  ///< unit
  glm::dvec3 directionIn(std::string_view field) const;
  glm::vec3 color(std::size_t i) const;
  double length(std::string_view field, const std::string& name) const;  ///< one number, above 0

  [[noreturn]] void refuse(const std::string& what) const;

 private:
  double number(std::string_view part, const std::string& name) const;

  std::string text_;
  std::vector<std::string> fields_;
};

/// A lamp's X axis, as seen from it to the left: level, where the direction leaves that open, and turned from
/// there about the direction.
glm::dvec3 levelSide(const glm::dvec3& direction, double degrees);

}  // namespace prelight::viewer
