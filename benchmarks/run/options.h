#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace prelight::benchmarks {

/// An option of a suite that the command line sets: `--set NAME=VALUE`.
struct SetOption {
  std::string name;
  std::string value;
};

/// Values of the command line that replace some suites' own. Each suite's takeGiven() says which it uses.
struct GivenValues {
  std::optional<std::uint64_t> rays;        ///< per vertex
  std::optional<std::uint64_t> samples;     ///< per pixel of path-traced pictures
  std::optional<std::uint64_t> photons;     ///< per room of `stability`
  std::optional<std::pair<int, int>> size;  ///< width and height of pictures, pixels
  std::vector<std::string> models = {};     ///< glTF files to measure in addition to a suite's own scenes
  std::vector<SetOption> options = {};      ///< applied last, in this order, to suites that have the option
};

/// Options of a run that every suite has.
struct RunOptions {
  bool quick = false;           ///< so little work that every suite ends within seconds; results mean nothing
  int runs = 5;                 ///< runs of each case, >= 1, after a warm-up
  double suiteSeconds = 540.0;  ///< time that `viewer`, `gather` and `techniques` take each, about
  std::string onlyCase = {};    ///< only cases whose names contain this text; empty: all
  std::filesystem::path folder = {};   ///< where suites write tables and pictures; empty: nowhere
  std::filesystem::path truths = {};   ///< where `techniques` keeps its path-traced pictures; empty: nowhere
  std::filesystem::path program = {};  ///< the program `prelight` that `bake-scaling` runs
  std::vector<std::filesystem::path> skies = {};  ///< .hdr or .exr, used by `wavelets` and `techniques`
  GivenValues given = {};

  /// Returns options of a run that shows within seconds that the suites work.
  static RunOptions quickRun();

  nlohmann::ordered_json toJson() const;
};

/// Texts that users read about an option of a suite.
struct OptionText {
  std::string name;
  std::string usual;   ///< its value in runs that are worth keeping, as JSON
  std::string quick;   ///< its value in quick runs
  std::string values;  ///< the values that it takes, such as "whole numbers from 1, ascending"
  std::string help;
};

/// Limits of the values of an option, or of each element of a list.
struct Limits {
  double least = 1.0;
  double most = 1e12;
  std::uint64_t multipleOf = 1;
  bool powerOfTwo = false;
  bool ascending = false;  ///< each element of a list is greater than the one before
};

/// How options are read from text and described. Readers throw std::invalid_argument for a text that is not
/// such a value; its message is not for users.
namespace option_values {

double numberOf(const std::string& text, bool whole, const Limits& limits);
std::pair<std::string, std::string> halvesOf(const std::string& text, char separator);
std::vector<std::string> elementsOf(const std::string& text);

inline void read(const std::string& text, const Limits&, std::string& value) {
  if (text.empty()) throw std::invalid_argument("empty");
  value = text;
}

template <typename Number>
requires std::is_arithmetic_v<Number>
void read(const std::string& text, Limits limits, Number& value) {
  limits.most = std::min(limits.most, static_cast<double>(std::numeric_limits<Number>::max()));
  value = static_cast<Number>(numberOf(text, std::is_integral_v<Number>, limits));
}

/// Reads a pair: "640x360", or "cornell:Short box".
template <typename Value>
void read(const std::string& text, const Limits& limits, std::pair<Value, Value>& value) {
  const auto [first, second] = halvesOf(text, std::is_arithmetic_v<Value> ? 'x' : ':');
  read(first, limits, value.first);
  read(second, limits, value.second);
}

/// Reads a list: elements with commas between them.
template <typename Element>
void read(const std::string& text, const Limits& limits, std::vector<Element>& value) {
  std::vector<Element> elements;
  for (const std::string& part : elementsOf(text)) {
    Element element{};
    read(part, limits, element);
    if (limits.ascending && !elements.empty() && !(elements.back() < element))
      throw std::invalid_argument("not ascending");
    elements.push_back(std::move(element));
  }
  value = std::move(elements);
}

/// Returns a text such as "whole numbers from 1 to 64, with commas between them".
std::string numbersText(bool whole, bool list, const Limits& limits);

template <typename Value>
std::string textOf(const Limits& limits) {
  if constexpr (std::is_arithmetic_v<Value>)
    return numbersText(std::is_integral_v<Value>, false, limits);
  else if constexpr (std::is_same_v<Value, std::string>)
    return "a name";
  else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
    return "names, with commas between them";
  else if constexpr (std::is_same_v<Value, std::vector<std::pair<int, int>>>)
    return "sizes such as 640x360, with commas between them";
  else if constexpr (std::is_same_v<Value, std::vector<std::pair<std::string, std::string>>>)
    return "pairs such as SCENE:NODE, with commas between them";
  else
    return numbersText(std::is_integral_v<typename Value::value_type>, true, limits);
}

/// Throws UsageError, which says what values the option takes.
[[noreturn]] void refuse(const SetOption& given, const std::string& values);

}  // namespace option_values

/// The options of a suite, each stated once: name, values and meaning. `Options` derives from RunOptions.
template <typename Options>
class OptionTable {
 public:
  /// Adds a row; `member` points into Options or a base of it.
  template <typename Value, typename Owner>
  OptionTable& add(const char* name, Value Owner::*member, std::type_identity_t<Value> usual,
                   std::type_identity_t<Value> quick, const char* help, const Limits& limits = {}) {
    const std::string values = option_values::textOf<Value>(limits);
    rows_.push_back({{name, Json(usual).dump(), Json(quick).dump(), values, help},
                     [=](Options& options) { options.*member = options.quick ? quick : usual; },
                     [=](const Options& options) { return Json(options.*member); },
                     [=](Options& options, const SetOption& given) {
                       try {
                         option_values::read(given.value, limits, options.*member);
                       } catch (const std::invalid_argument&) {
                         option_values::refuse(given, values);
                       }
                     }});
    return *this;
  }

  /// Adds an option whose value quick runs share.
  template <typename Value, typename Owner>
  OptionTable& add(const char* name, Value Owner::*member, const std::type_identity_t<Value>& value,
                   const char* help, const Limits& limits = {}) {
    return add(name, member, value, value, help, limits);
  }

  /// Gives every option the value that it has in runs of this kind, usual or quick.
  void reset(Options& options) const {
    for (const Row& row : rows_) row.reset(options);
  }

  /// Sets an option, if the table has it. Throws UsageError for a value that it does not take.
  void set(Options& options, const SetOption& given) const {
    for (const Row& row : rows_)
      if (row.text.name == given.name) row.set(options, given);
  }

  nlohmann::ordered_json toJson(const Options& options) const {
    Json json = Json::object();
    for (const Row& row : rows_) json[row.text.name] = row.value(options);
    return json;
  }

  std::vector<OptionText> texts() const {
    std::vector<OptionText> texts;
    for (const Row& row : rows_) texts.push_back(row.text);
    return texts;
  }

 private:
  using Json = nlohmann::ordered_json;

  struct Row {
    OptionText text;
    std::function<void(Options&)> reset;
    std::function<Json(const Options&)> value;
    std::function<void(Options&, const SetOption&)> set;
  };

  std::vector<Row> rows_;
};

/// Returns a suite's options in a run: those of its table, then what the command line gives in their place.
/// Throws UsageError for a value that an option does not take.
template <typename Options>
Options optionsIn(const RunOptions& run) {
  Options options{};
  static_cast<RunOptions&>(options) = run;
  Options::table().reset(options);
  if constexpr (requires { options.takeGiven(); }) options.takeGiven();
  for (const SetOption& given : run.given.options) Options::table().set(options, given);
  return options;
}

}  // namespace prelight::benchmarks
