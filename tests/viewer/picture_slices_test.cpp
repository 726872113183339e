// Slices of pictures and sizes of drafts, with costs that are made up.
#include "viewer/core/picture_slices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

#include "viewer/core/sliced_work.h"

namespace prelight::viewer {
namespace {

constexpr int width = 2560, height = 1440;
constexpr double budget = 0.025;

/// Time of samples at a place, s.
using Cost = std::function<double(int x, int y)>;

/// A run through the slices of a picture on a clock that counts the cost of what is drawn.
struct SlicedRun {
  std::vector<SampleRect> rects;
  std::vector<double> seconds;
  std::vector<int> timesDrawn = std::vector<int>(static_cast<std::size_t>(width) * height);

  SlicedRun(double overhead, const Cost& cost) {
    PictureSlices slices(width, height, budget);
    while (!slices.done()) {
      const SampleRect rect = slices.next();
      const double took = overhead + static_cast<double>(rect.area()) *
                                         cost(rect.x + rect.width / 2, rect.y + rect.height / 2);
      slices.drew(took);
      rects.push_back(rect);
      seconds.push_back(took);
      for (int y = rect.y; y < rect.y + rect.height; ++y)
        for (int x = rect.x; x < rect.x + rect.width; ++x)
          ++timesDrawn[static_cast<std::size_t>(y) * width + x];
    }
  }

  double samples() const {
    double sum = 0.0;
    for (const SampleRect& rect : rects) sum += static_cast<double>(rect.area());
    return sum;
  }
  double total() const {
    double sum = 0.0;
    for (const double s : seconds) sum += s;
    return sum;
  }
  double longest() const { return *std::max_element(seconds.begin(), seconds.end()); }
};

TEST(PictureSlices, OfAnyCost_CoverEverySample_AndNoneTwiceButInProbes) {
  for (const double cost : {0.0, 1e-9, 3e-6, 1e-4}) {
    const SlicedRun run(1e-3, [&](int, int) { return cost; });
    EXPECT_TRUE(std::ranges::all_of(run.timesDrawn, [](int times) { return times > 0; })) << cost;
    const double ofProbes = PictureSlices::probes * PictureSlices::leastSide * PictureSlices::leastSide;
    EXPECT_LE(run.samples(), ofProbes + width * height) << cost;
  }
}

TEST(PictureSlices, OfEvenCost_TakeAboutTheTimeAskedFor) {
  const SlicedRun run(5e-4, [](int, int) { return 3e-6; });
  EXPECT_LT(run.longest(), 2.0 * budget);
  EXPECT_LT(static_cast<double>(run.rects.size()), 2.0 * run.total() / budget);
}

/// A sky that costs nothing above a model: slices have grown when they come to it.
TEST(PictureSlices, WhereCheapSamplesEnd_StayShort) {
  for (const int edge : {height / 3, height / 2, 2 * height / 3}) {
    const SlicedRun run(5e-4, [&](int, int y) { return y < edge ? 3e-6 : 1e-9; });
    EXPECT_LT(run.longest(), 3.0 * budget) << edge;
  }
}

/// Slices that take long however small they are do not become ever more.
TEST(PictureSlices, OfMuchThatEachTakesAlike_AreFew) {
  const double overhead = 0.2, samples = 1e-7;
  const SlicedRun run(overhead, [&](int, int) { return samples; });
  EXPECT_LT(run.total(), 4.0 * (overhead + samples * width * height) + PictureSlices::probes * overhead);
}

TEST(PictureSlices, Unbounded_AreThePicture) {
  PictureSlices slices(width, height, PictureSlices::unbounded);
  EXPECT_EQ(slices.next(), (SampleRect{0, 0, width, height}));
  slices.drew(100.0);
  EXPECT_TRUE(slices.done());
}

TEST(PictureSlices, OfATinyPicture_AreOne) {
  PictureSlices slices(3, 2, budget);
  EXPECT_EQ(slices.next(), (SampleRect{0, 0, 3, 2}));
  slices.drew(1.0);
  EXPECT_TRUE(slices.done());
}

/// Divisors of drafts that take `fixed` seconds and some for each pixel.
std::vector<int> divisorsOf(double fixed, double ofAllPixels, int drafts) {
  DraftSize size;
  std::vector<int> divisors;
  for (int i = 0; i < drafts; ++i) {
    divisors.push_back(size.divisor());
    size.drew((i == 0 ? 1.0 : fixed) + ofAllPixels / (size.divisor() * size.divisor()));
  }
  return divisors;
}

TEST(DraftSize, OfQuickPictures_BecomesThatOfTheWindow) {
  EXPECT_EQ(divisorsOf(0.0, 0.01, 4), (std::vector<int>{4, 4, 2, 1}));
}

TEST(DraftSize, OfSlowPictures_KeepsTheirTimeBelowTheLimit_AndSettles) {
  for (const double seconds : {0.1, 0.3, 0.7, 2.0}) {
    const std::vector<int> divisors = divisorsOf(0.004, seconds, 12);
    EXPECT_EQ(divisors[10], divisors[11]) << seconds;
    EXPECT_LE(0.004 + seconds / (divisors[11] * divisors[11]), DraftSize::limit) << seconds;
  }
  EXPECT_EQ(divisorsOf(0.0, 100.0, 12).back(), DraftSize::mostDivisor);
}

/// Work that takes the same time at every size is no reason for few pixels.
TEST(DraftSize, OfTimeThatPixelsDoNotTake_IsFineNevertheless) {
  EXPECT_EQ(divisorsOf(0.02, 0.01, 12).back(), 1);
}

SlicedWork count(int slices, int& done) {
  for (int i = 0; i < slices; ++i) {
    ++done;
    co_await endOfSlice;
  }
  if (slices > 5) throw std::runtime_error("too many");
}

TEST(SlicedWork, GoesOnBySlices_AndThrowsWhatItThrows) {
  int done = 0;
  SlicedWork work = count(2, done);
  EXPECT_EQ(done, 0);
  EXPECT_TRUE(work.goOn());
  EXPECT_EQ(done, 1);
  EXPECT_TRUE(work.goOn());
  EXPECT_FALSE(work.goOn());
  EXPECT_FALSE(work.goOn());
  EXPECT_EQ(done, 2);
  EXPECT_THROW(count(6, done).finish(), std::runtime_error);
}

TEST(SlicedWork, Abandoned_DoesNoMore) {
  int done = 0;
  { count(4, done).goOn(); }
  EXPECT_EQ(done, 1);
}

}  // namespace
}  // namespace prelight::viewer
