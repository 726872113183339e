#pragma once

#include <memory>
#include <string>
#include <utility>

#include "prelight/transfer.h"
#include "relight/device/harmonic_light.h"
#include "relight/device/relighting.h"
#include "relight/device/series_relighter.h"

namespace prelight {

/// Transfer in SH.
class HarmonicPart : public RelitPart {
 public:
  /// The device must outlive the part.
  HarmonicPart(std::unique_ptr<SeriesRelighter> series, int order, DeviceContext& device)
      : series_(std::move(series)), light_(device, order) {}

  std::size_t receiverCount() const override { return series_->receiverCount(); }
  std::size_t bytesMoved() const override { return series_->bytesMoved(); }
  void light(const RelighterLight& light) override { series_->setLight(light_.coefficientsOf(light)); }
  void relight(Buffer<float>& radiance) override { series_->relight(radiance); }

 protected:
  std::unique_ptr<SeriesRelighter> series_;
  HarmonicLight light_;
};

/// Returns the relighter of compressed transfer. Transfer with shared exponents is unpacked.
std::unique_ptr<SeriesRelighter> makeCompressedSeries(DeviceContext& device,
                                                      const CompressedTransfer& transfer);

/// Return the forms of dense and compressed transfer in words.
std::string denseForm(int order, int channels);
std::string compressedForm(const CompressedTransfer& transfer);

}  // namespace prelight
