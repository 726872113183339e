#include "techniques/haar/haar_technique.h"

#include <fmt/format.h>

#include "techniques/haar/haar_file.h"
#include "techniques/summary_text.h"

namespace prelight {

namespace {

std::size_t bytesOfHaar(const Bake& bake) { return bake.haar ? storedBytes(*bake.haar) : 0; }

void summarizeHaar(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.haar) return;
  const HaarTransfer& transfer = *bake.haar;
  const std::size_t bytes = bytesOfHaar(bake);
  const std::size_t rows = transfer.offsets.empty() ? 0 : transfer.offsets.size() - 1;
  const double mean =
      rows == 0 ? 0.0 : static_cast<double>(transfer.values.size()) / static_cast<double>(rows);
  found.push_back(
      {"haar",
       fmt::format("Haar wavelets on 6 x {0} x {0} texels, {1}; {2:.1f} of {3} coefficients per row",
                   transfer.faceSize, channelsText(transfer.channels, transfer.bounces), mean,
                   6 * transfer.faceSize * transfer.faceSize),
       bytes,
       true,
       {{"faceSize", transfer.faceSize},
        {"channels", transfer.channels},
        {"bounces", transfer.bounces},
        {"coefficientsPerRow", mean},
        {"bytes", bytes}}});
}

}  // namespace

std::size_t storedBytes(const HaarTransfer& haar) {
  return bytesOf(haar.offsets) + haar.indices.size() * haar.storedIndexBytes() + bytesOf(haar.values);
}

Technique haarTechnique() {
  return {.name = "haar",
          .members = {"haar"},
          .accessors = {"offsets", "indices", "values"},
          .storedBytes = bytesOfHaar,
          .writeEntry = writeHaar,
          .makeReader = makeHaarReader,
          .summarize = summarizeHaar};
}

}  // namespace prelight
