#pragma once

#include <memory>
#include <string>
#include <vector>

#include "prelight/transfer.h"
#include "relight/device/harmonic_light.h"
#include "relight/device/open_lights.h"
#include "relight/device/relighting.h"
#include "relight/device/series_relighter.h"

namespace prelight {

/// Transfer in SH, or in another basis by inBasis().
class HarmonicPart : public RelitPart {
 public:
  /// The device must outlive the part. `open`, where it is not nullptr, lights receivers by distant lights.
  HarmonicPart(std::unique_ptr<SeriesRelighter> series, int order, DeviceContext& device,
               std::unique_ptr<OpenLights> open = nullptr);

  std::size_t receiverCount() const override { return series_->receiverCount(); }
  std::size_t bytesMoved() const override;
  void light(const RelighterLight& light) override;
  void relight(Buffer<float>& radiance) override;

 protected:
  std::unique_ptr<SeriesRelighter> series_;

 private:
  /// Returns light in SH, [channel][i], in the form that the transfer is multiplied with.
  virtual std::vector<double> inBasis(std::vector<double> sh) const { return sh; }

  HarmonicLight light_;
  std::unique_ptr<OpenLights> open_;
  Buffer<float> through_;  ///< [receiver][3] of one light
};

/// Returns the relighter of compressed transfer. Transfer with shared exponents is unpacked.
std::unique_ptr<SeriesRelighter> makeCompressedSeries(DeviceContext& device,
                                                      const CompressedTransfer& transfer);

/// Return the forms of dense and compressed transfer in words.
std::string denseForm(int order, int channels);
std::string compressedForm(const CompressedTransfer& transfer);

}  // namespace prelight
