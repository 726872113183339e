#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "prelight/options.h"

namespace prelight::test {

/// Values at the ends of what an option takes.
inline std::vector<double> endsOf(const OptionInfo& row) {
  switch (row.kind) {
    case OptionKind::Flag:
      return {0.0, 1.0};
    case OptionKind::Number:
      return {row.range.least, row.range.most};
    case OptionKind::Choice:
      return {0.0, static_cast<double>(row.choices.size() - 1)};
    case OptionKind::Own:
      break;
  }
  return {};
}

inline void expectSound(const NumberRange& range) {
  EXPECT_LT(range.least, range.most);
  EXPECT_TRUE(range.contains(range.least) && range.contains(range.most));
  EXPECT_FALSE(range.contains(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(range.zero != nullptr && range.contains(0.0)) << "0 cannot mean two things";
}

/// Expects a row's names to be new among those of its table, its default to be permitted and its values to
/// arrive in the structure.
template <typename Options>
void expectSound(const Option<Options>& row, std::set<std::string>& fields, std::set<std::string>& names) {
  SCOPED_TRACE(row.field);
  EXPECT_TRUE(fields.insert(row.field).second) << "is there twice";
  EXPECT_TRUE(names.insert(row.name).second) << row.name;
  EXPECT_NE(std::string(row.help), "");
  if (row.kind == OptionKind::Number) {
    expectSound(row.range);
    EXPECT_TRUE(row.range.allows(row.usualValue().value_or(row.range.least))) << "the default";
    EXPECT_LE(row.usual.least, row.usual.most);
  }
  Options options;
  for (const double value : endsOf(row)) {
    row.set(options, value);
    EXPECT_NEAR(row.get(options).value_or(-1.0), value, 1e-12 * std::abs(value)) << value;
  }
}

}  // namespace prelight::test
