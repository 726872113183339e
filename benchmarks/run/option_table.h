#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "benchmarks/run/run_options.h"

namespace prelight::benchmarks {

/// Texts that users read about an option of a suite.
struct OptionText {
  std::string name;
  std::string usual;  ///< its value in runs that are worth keeping, as JSON
  std::string quick;  ///< its value in quick runs
  std::string help;
};

/// The options of a suite, each stated once: name, values and meaning. `Options` derives from RunOptions.
template <typename Options>
class OptionTable {
 public:
  /// Adds a row; `member` points into Options or a base of it.
  template <typename Value, typename Owner>
  OptionTable& add(const char* name, Value Owner::*member, std::type_identity_t<Value> usual,
                   std::type_identity_t<Value> quick, const char* help) {
    rows_.push_back({{name, Json(usual).dump(), Json(quick).dump(), help},
                     [=](Options& options) { options.*member = options.quick ? quick : usual; },
                     [=](const Options& options) { return Json(options.*member); }});
    return *this;
  }

  /// Adds an option whose value quick runs share.
  template <typename Value, typename Owner>
  OptionTable& add(const char* name, Value Owner::*member, const std::type_identity_t<Value>& value,
                   const char* help) {
    return add(name, member, value, value, help);
  }

  /// Gives every option the value that it has in runs of this kind, usual or quick.
  void reset(Options& options) const {
    for (const Row& row : rows_) row.reset(options);
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
  };

  std::vector<Row> rows_;
};

/// A suite's options in a run: those of its table, then what the command line gives in their place.
template <typename Options>
Options optionsIn(const RunOptions& run) {
  Options options{};
  static_cast<RunOptions&>(options) = run;
  Options::table().reset(options);
  if constexpr (requires { options.takeGiven(); }) options.takeGiven();
  return options;
}

}  // namespace prelight::benchmarks
