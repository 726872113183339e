#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace prelight {

/// Returns the value of a non-negative integer in any notation (JSON does not distinguish 3 and 3.0); nullopt
/// for other values.
std::optional<std::uint64_t> unsignedValue(const nlohmann::ordered_json& json);

/// A place in a JSON tree that knows its path, so that every error about it names file and path. The tree and
/// the file name must outlive the cursor. All accessors throw InputError when the value is not of the
/// requested kind.
class JsonCursor {
 public:
  using Json = nlohmann::ordered_json;

  JsonCursor(const std::string& file, const Json& root) : file_(&file), value_(&root) {}

  const Json& value() const { return *value_; }

  /// Returns "FILE: /json/path".
  std::string where() const { return *file_ + ": " + (path_.empty() ? "/" : path_); }
  [[noreturn]] void fail(const std::string& what, const std::string& fix = {}) const;

  /// Returns the member `key`; this value must be an object that has it.
  JsonCursor at(std::string_view key) const;
  /// Returns the member `key`, if this object has it.
  std::optional<JsonCursor> find(std::string_view key) const;
  /// Returns element `index` of this array, which must be in range.
  JsonCursor at(std::size_t index) const;

  void expectObject() const;
  /// Returns the length of this array; fails when it is none.
  std::size_t arraySize() const;

  std::uint64_t asUnsigned() const;
  /// Returns an index that is below `count`; `kind` names the indexed things in messages.
  std::size_t asIndex(std::size_t count, std::string_view kind) const;
  double asNumber() const;
  bool asBool() const;
  const std::string& asString() const;
  void expectNumbers(std::size_t count) const;

  std::uint64_t unsignedOr(std::string_view key, std::uint64_t fallback) const;
  double numberOr(std::string_view key, double fallback) const;
  bool boolOr(std::string_view key, bool fallback) const;
  std::string stringOr(std::string_view key, const std::string& fallback) const;

  /// Calls visit(cursor, key) for every member of this object.
  template <class Visit>
  void forEachMember(Visit visit) const {
    expectObject();
    for (const auto& member : value_->items()) visit(memberAt(member.key(), member.value()), member.key());
  }

  /// Returns the number of elements of the array member `key`; 0 when there is none.
  std::size_t countOf(std::string_view key) const;

  /// Calls visit(cursor, index) for every element of the array member `key`, each of which must be an object.
  template <class Visit>
  void forEachObject(std::string_view key, Visit visit) const {
    const std::optional<JsonCursor> array = find(key);
    if (!array) return;
    const std::size_t count = array->arraySize();
    for (std::size_t i = 0; i < count; ++i) {
      const JsonCursor item = array->at(i);
      item.expectObject();
      visit(item, i);
    }
  }

 private:
  JsonCursor memberAt(std::string_view key, const Json& value) const;
  JsonCursor(const std::string* file, const Json* value, std::string path)
      : file_(file), value_(value), path_(std::move(path)) {}

  const std::string* file_;
  const Json* value_;
  std::string path_;
};

/// Parses JSON text. Throws InputError naming line and column, also when its nesting or the number of an
/// object's members exceeds what the parser can handle safely.
nlohmann::ordered_json parseJson(std::string_view text, const std::string& file);

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
