#include <gtest/gtest.h>

#include <string>

#include "scene/gltf/json_cursor.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// Objects with few and with many members, some of them duplicated, are read as by the library's own parser.
TEST(ParseJson, AnyTree_IsTheLibrarysOwn) {
  std::string many = "{";
  for (int i = 0; i < 100; ++i)
    many += "\"k" + std::to_string(i * 7 % 60) + "\": [" + std::to_string(i) + ", {\"a\": null}],";
  many.back() = '}';
  for (const std::string& text :
       {std::string("{}"), std::string("[]"), std::string("-3"), std::string("18446744073709551615"),
        std::string(R"("x")"), std::string(R"({"b": 1, "a": [1, 2.5, -3, true, null, {}], "b": {"c": []}})"),
        std::string(R"([[[]], {"a": {"a": {"a": false}}}, "\u00e9\n"])"), many}) {
    const Json expected = Json::parse(text);
    const Json got = parseJson(text, "file");
    EXPECT_EQ(got, expected);
    EXPECT_EQ(got.dump(), expected.dump()) << "another order";
  }
}

}  // namespace
}  // namespace prelight
