// Cases that end in every way, for run_cases_test.py.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace {

void crash() {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  std::raise(SIGSEGV);
}

TEST(Ending, Passes) {}

TEST(Ending, Fails) {
  std::puts("said before it fails");
  ADD_FAILURE();
}

TEST(Ending, Crashes) {
  std::fputs("said before it crashes", stdout);
  std::fflush(stdout);
  crash();
}

TEST(Ending, Skips) { GTEST_SKIP(); }

TEST(Ending, Exits) { std::_Exit(0); }

/// What it has started outlives it, unless the runner ends that too.
TEST(Ending, SleepsForGood) {
  ::fork();
  ::sleep(1000);
}

TEST(Ending, PassesWithoutANewline) { std::fputs("said without a newline", stdout); }

class CrashingSuite : public testing::Test {
 protected:
  static void SetUpTestSuite() { crash(); }
};

TEST_F(CrashingSuite, First) {}
TEST_F(CrashingSuite, Second) {}

class Numbered : public testing::TestWithParam<int> {};

TEST_P(Numbered, IsOdd) { EXPECT_EQ(GetParam() % 2, 1); }

INSTANTIATE_TEST_SUITE_P(Some, Numbered, testing::Values(1, 2, 3));

TEST(Ending, DISABLED_IsNotRun) { FAIL(); }

class FailingSuite : public testing::Test {
 protected:
  static void TearDownTestSuite() { ADD_FAILURE() << "said while the suite ends"; }
};

TEST_F(FailingSuite, Only) {}

/// Counts the cases that have run in its process.
int started = 0;

TEST(Process, First) { EXPECT_EQ(++started, 1); }
TEST(Process, Second) { EXPECT_EQ(++started, 2); }

}  // namespace
