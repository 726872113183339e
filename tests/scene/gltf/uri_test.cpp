#include "scene/gltf/uri.h"

#include <gtest/gtest.h>

namespace prelight {
namespace {

std::string text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

TEST(PercentDecode, EscapesAndStrayPercents_DecodeAndStay) {
  EXPECT_EQ(percentDecode("a%20b%2Fc"), "a b/c");
  EXPECT_EQ(percentDecode("50%"), "50%");
  EXPECT_EQ(percentDecode("%4"), "%4");
  EXPECT_EQ(percentDecode("%zz%41"), "%zzA");
}

TEST(DecodeBase64, PaddedUnpaddedAndSpaced_GiveTheSameBytes) {
  EXPECT_EQ(text(*decodeBase64("SGVsbG8=")), "Hello");
  EXPECT_EQ(text(*decodeBase64("SGVsbG8")), "Hello");
  EXPECT_EQ(text(*decodeBase64("SGVs\nbG8=")), "Hello");
  EXPECT_EQ(text(*decodeBase64("")), "");
}

TEST(DecodeBase64, ForeignCharacterOrLoneDigit_IsRefused) {
  EXPECT_FALSE(decodeBase64("SGV*bG8="));
  EXPECT_FALSE(decodeBase64("S"));
  EXPECT_FALSE(decodeBase64("SG=VsbG8"));
}

TEST(ParseDataUri, AnyMimeTypeWithAndWithoutBase64_Decodes) {
  EXPECT_EQ(text(parseDataUri("data:application/gltf-buffer;base64,SGVsbG8=")->bytes), "Hello");
  EXPECT_EQ(text(parseDataUri("data:;base64,SGVsbG8=")->bytes), "Hello");
  EXPECT_EQ(text(parseDataUri("data:text/plain;charset=utf-8;BASE64,SGVsbG8=")->bytes), "Hello");
  EXPECT_EQ(text(parseDataUri("data:text/plain,He%6Clo")->bytes), "Hello");
  EXPECT_EQ(text(parseDataUri("DATA:,x")->bytes), "x");
  EXPECT_EQ(parseDataUri("data:image/x-strange;base64,AA==")->mimeType, "image/x-strange");
}

TEST(ParseDataUri, NoCommaOrBadBase64_IsRefused) {
  EXPECT_FALSE(parseDataUri("data:text/plain;base64"));
  EXPECT_FALSE(parseDataUri("data:;base64,%%%"));
  EXPECT_FALSE(parseDataUri("file.bin"));
}

}  // namespace
}  // namespace prelight
