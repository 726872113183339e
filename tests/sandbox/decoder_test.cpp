#include "sandbox/decoder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <limits>
#include <new>
#include <thread>

#include "images/picture_decoding.h"
#include "images/picture_jobs.h"
#include "prelight/error.h"
#include "sandbox/job_server.h"
#include "sandbox/job_verdict.h"
#include "support/environment_variable.h"

namespace prelight {
namespace {

using ::testing::HasSubstr;

/// Two ends of a socket, of which a test plays the decoding process's.
class PlayedDecoder : public ::testing::Test {
 protected:
  PlayedDecoder() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
    session = std::make_unique<DecoderSession>(ends[0]);
    decoder = std::make_unique<JobSocket>(ends[1]);
  }

  /// Asks for a result of type Result. Returns the message of the InputError that it throws, else nothing.
  template <typename Result>
  std::string problemOfResult() {
    Result result;
    try {
      session->ask(
          "here", [](JobSocket&) {}, [&](JobSocket& socket) { getResult(socket, result); });
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  std::unique_ptr<DecoderSession> session;
  std::unique_ptr<JobSocket> decoder;
};

TEST_F(PlayedDecoder, ProcessThatEnds_IsAnErrorOfTheData) {
  decoder.reset();
  EXPECT_THAT(problemOfResult<Image>(), HasSubstr("here: its decoder crashed"));
}

TEST_F(PlayedDecoder, SizesThatNoPictureHas_AreRefusedBeforeMemoryIsTaken) {
  decoder->put(JobVerdict::Done);
  decoder->put(1 << 15);
  decoder->put(1 << 14);
  EXPECT_THAT(problemOfResult<Image>(), HasSubstr("here: "));
}

TEST_F(PlayedDecoder, NegativeSizes_AreRefused) {
  decoder->put(JobVerdict::Done);
  decoder->put(-1);
  decoder->put(-1);
  EXPECT_THAT(problemOfResult<Pixels>(), HasSubstr("here: "));
}

TEST_F(PlayedDecoder, FewerOrMoreTexelsThanTheSize_AreRefused) {
  for (const std::size_t count :
       {std::size_t{23}, std::size_t{25}, std::numeric_limits<std::size_t>::max()}) {
    decoder->put(JobVerdict::Done);
    decoder->put(3);
    decoder->put(2);
    decoder->put(std::uint64_t{count});
    decoder->put(std::array<char, 23>{});
    EXPECT_THAT(problemOfResult<Image>(), HasSubstr("here: ")) << count;
  }
}

TEST_F(PlayedDecoder, ChannelsWithoutEnd_AreRefused) {
  decoder->put(JobVerdict::Done);
  decoder->put(3);
  decoder->put(2);
  decoder->put(std::numeric_limits<std::uint64_t>::max());
  EXPECT_THAT(problemOfResult<PictureLayers>(), HasSubstr("here: "));
}

TEST_F(PlayedDecoder, OutOfMemory_IsThatHere) {
  decoder->put(JobVerdict::OutOfMemory);
  EXPECT_THROW(problemOfResult<Image>(), std::bad_alloc);
}

TEST_F(PlayedDecoder, CodesThatNoDecoderHas_AreFailures) {
  decoder->put(JobVerdict::Failed);
  decoder->put(ExitCode::Done);
  for (const char* part : {"place", "problem", "fix"}) decoder->putText(part);
  try {
    problemOfResult<Image>();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::RuntimeFailure);
    EXPECT_EQ(error.where(), "place");
  }
}

TEST_F(PlayedDecoder, ErrorsOfWork_ArriveWhole) {
  std::thread server([&] {
    serveJobs(*decoder, [](JobSocket&) -> SendResult { throw InputError("a.png", "broken", "mend it"); });
  });
  EXPECT_EQ(problemOfResult<Image>(), "a.png: broken (mend it)");
  EXPECT_EQ(problemOfResult<Image>(), "a.png: broken (mend it)") << "the session goes on";
  session.reset();
  server.join();
}

TEST_F(PlayedDecoder, Results_ArriveWhole) {
  const PictureLayers layers{2, 1, {{"R", {0.5f, 2.0f}}, {"depth", {-1.0f, 7.0f}}}};
  decoder->put(JobVerdict::Done);
  putResult(*decoder, layers);
  PictureLayers back;
  session->ask(
      "", [](JobSocket&) {}, [&](JobSocket& socket) { getResult(socket, back); });
  EXPECT_EQ(back.width, 2);
  EXPECT_EQ(back.height, 1);
  ASSERT_EQ(back.channels.size(), 2u);
  EXPECT_EQ(back.channels[1].name, "depth");
  EXPECT_EQ(back.channels[1].values, layers.channels[1].values);
}

TEST(DecoderSession, SwitchedOffByTheUser_IsNone) {
  const test::EnvironmentVariable off("PRELIGHT_SANDBOX", "0");
  EXPECT_EQ(DecoderSession::begin(DecoderJob::PlainPng), nullptr);
}

TEST(DecoderSession, Begins_AndAgainAfterTheProgramHasLeft) {
  EXPECT_NE(DecoderSession::begin(DecoderJob::PlainPng), nullptr);
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  EXPECT_NE(DecoderSession::begin(DecoderJob::PlainPng), nullptr);
}

TEST(DecoderSession, BrokenPictures_HaveTheSameErrorInBothProcesses) {
  const std::vector<std::uint8_t> bytes{0xff, 0xd8, 0xff, 0xe0, 0, 0, 0, 0};
  std::string messages[2];
  for (const char* value : {"0", "1"}) {
    const test::EnvironmentVariable sandbox("PRELIGHT_SANDBOX", value);
    try {
      decodeTexels(bytes, PictureFormat::Jpeg, "a.jpg");
    } catch (const InputError& error) {
      messages[*value - '0'] = error.what();
    }
  }
  EXPECT_THAT(messages[0], HasSubstr("a.jpg: cannot decode the picture"));
  EXPECT_EQ(messages[1], messages[0]);
}

TEST(DecoderSession, ManyAtOnce_AreServed) {
  std::vector<std::thread> threads;
  std::array<bool, 16> begun{};
  for (bool& mine : begun)
    threads.emplace_back([&mine] { mine = DecoderSession::begin(DecoderJob::PlainPng) != nullptr; });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(begun, ::testing::Each(true));
}

}  // namespace
}  // namespace prelight
