#include "sandbox/rights.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <memory>
#include <vector>

#include "support/own_process.h"

namespace prelight {
namespace {

constexpr int given = 100;  ///< the right is there, and nothing else went wrong

/// Returns the errno of `call` after rights were given up, `given` if it succeeds.
template <typename Call>
int errnoWithoutRights(Call call) {
  return test::inOwnProcess([&] {
    if (!giveUpRights()) return 101;
    return call() < 0 ? errno : given;
  });
}

TEST(RightsGivenUp, FilesProgramsNetworkAndOtherProcesses_AreOutOfReach) {
  EXPECT_EQ(errnoWithoutRights([] { return ::open("/etc/passwd", O_RDONLY | O_CLOEXEC); }), EPERM);
  EXPECT_EQ(errnoWithoutRights([] { return ::open("/tmp/x", O_WRONLY | O_CREAT | O_CLOEXEC, 0600); }), EPERM);
  EXPECT_EQ(errnoWithoutRights([] { return ::unlink("/tmp/x"); }), EPERM);
  EXPECT_EQ(errnoWithoutRights([] { return ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0); }), EPERM);
  EXPECT_EQ(errnoWithoutRights([] { return ::kill(::getppid(), 0); }), EPERM);
  EXPECT_EQ(errnoWithoutRights([] { return ::fork(); }), EPERM);
  EXPECT_EQ(errnoWithoutRights([] {
              std::vector<char> name{'/', 'b', 'i', 'n', '/', 's', 'h', '\0'};
              char* const arguments[] = {name.data(), nullptr};
              return ::execv(name.data(), arguments);
            }),
            EPERM);
}

TEST(RightsGivenUp, NoMemoryBecomesCode) {
  const auto map = [](int protection) {
    return ::mmap(nullptr, 4096, protection, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED ? -1 : 0;
  };
  EXPECT_EQ(errnoWithoutRights([&] { return map(PROT_READ | PROT_WRITE); }), given);
  EXPECT_EQ(errnoWithoutRights([&] { return map(PROT_READ | PROT_EXEC); }), EPERM);
  EXPECT_EQ(errnoWithoutRights([&] {
              void* page = ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
              return ::mprotect(page, 4096, PROT_READ | PROT_EXEC);
            }),
            EPERM);
}

TEST(RightsGivenUp, OpenFilesAndMemory_AreStillThere) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  EXPECT_EQ(errnoWithoutRights([&] {
              const std::vector<char> much(std::size_t{50} << 20, 'x');
              char back = 0;
              return ::write(ends[1], much.data() + 1000, 1) == 1 && ::read(ends[0], &back, 1) == 1 &&
                             back == 'x'
                         ? 0
                         : -1;
            }),
            given);
}

TEST(RightsGivenUp, EndlessWork_IsKilled) {
  EXPECT_EQ(test::inOwnProcess([] {
              const rlimit second{1, 1};
              if (::setrlimit(RLIMIT_CPU, &second) != 0 || !giveUpRights()) return 1;
              for (;;) (void)::getppid();
            }),
            128 + SIGKILL)
      << "a lower limit of the user's holds";
  EXPECT_EQ(test::inOwnProcess([] {
              giveUpRights();
              return 0;
            }),
            0);
}

}  // namespace
}  // namespace prelight
