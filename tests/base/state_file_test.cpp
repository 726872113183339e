#include "base/state_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "prelight/error.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class StateFile : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = folder_ / "out.glb.state";
    StateWriter writer;
    writer.value(7);
    writer.values(std::vector<double>{1.5, -2.0, 0.25});
    writer.values(std::vector<std::uint8_t>{});
    writeStateFile(path_, "bake", key_, writer.payload());
  }

  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void replace(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

  std::string inputError() const {
    try {
      readStateFile(path_, "bake", key_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder temporary_;
  fs::path folder_ = temporary_.path(), path_;
  StateKey key_ = {{"scene", 1}, {"options", 2}, {"seed", 3}};
};

TEST_F(StateFile, Payload_ComesBack) {
  std::optional<StateReader> reader = readStateFile(path_, "bake", key_);
  ASSERT_TRUE(reader);
  int seven = 0;
  std::vector<double> doubles(3);
  std::vector<std::uint8_t> none(5);
  reader->value(seven);
  reader->sameSize(doubles);
  reader->values(none);
  EXPECT_EQ(seven, 7);
  EXPECT_EQ(doubles, (std::vector<double>{1.5, -2.0, 0.25}));
  EXPECT_TRUE(none.empty());
  EXPECT_THROW(reader->value(seven), InputError) << "nothing is left";
}

TEST_F(StateFile, OtherLengthThanExpected_IsRefused) {
  std::optional<StateReader> reader = readStateFile(path_, "bake", key_);
  int seven = 0;
  std::vector<double> doubles(2);
  reader->value(seven);
  EXPECT_THROW(reader->sameSize(doubles), InputError);
}

TEST_F(StateFile, NoFile_IsNothing) { EXPECT_FALSE(readStateFile(folder_ / "none", "bake", key_)); }

TEST_F(StateFile, EveryCutAndEveryFlippedByte_IsRefused) {
  const std::string whole = bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    replace(whole.substr(0, size));
    EXPECT_THROW(readStateFile(path_, "bake", key_), Error) << "cut to " << size;
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    replace(damaged);
    EXPECT_THROW(readStateFile(path_, "bake", key_), Error) << "byte " << i;
  }
  replace(whole);
  EXPECT_TRUE(readStateFile(path_, "bake", key_));
  replace(whole + "x");
  EXPECT_THAT(inputError(), HasSubstr("damaged"));
}

TEST_F(StateFile, AnotherRuns_IsBadUsageThatNamesTheDifference) {
  try {
    readStateFile(path_, "bake", {{"scene", 1}, {"options", 9}, {"seed", 4}});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("another options, seed"));
  }
}

TEST_F(StateFile, AnotherKind_IsRefused) {
  EXPECT_THROW(readStateFile(path_, "reference", key_), InputError);
  replace("something else entirely");
  EXPECT_THAT(inputError(), HasSubstr("not a state"));
}

TEST(StateHash, DependsOnEveryByteAndOnBoundaries) {
  const auto hash = [](const std::vector<std::uint32_t>& v) { return StateHash().values(v).result(); };
  EXPECT_EQ(hash({1, 2, 3}), hash({1, 2, 3}));
  EXPECT_NE(hash({1, 2, 3}), hash({1, 2, 4}));
  EXPECT_NE(hash({1, 2, 3}), hash({1, 2, 0x80000003u}));
  EXPECT_NE(hash({1, 0}), hash({1}));
  EXPECT_NE(StateHash().text("ab").text("c").result(), StateHash().text("a").text("bc").result());
}

}  // namespace
}  // namespace prelight
