#pragma once

#include <utility>
#include <vector>

#include "gi/final_gather.h"

namespace prelight {

/// Casts rays stratified in both angles and makes records for an irradiance cache of them.
class RecordGather final : public GatherPattern {
 public:
  explicit RecordGather(const FinalGather& gather);

  void makeRays(const GatherBlock& block) override;
  void meet(const GatherBlock& block) override;
  void sum(const GatherBlock& block) override;

  /// Takes the records of all blocks so far, [receiver].
  std::vector<device::GatherRecord> take() { return std::exchange(records_, {}); }

 private:
  std::vector<device::GatherRecord> records_;
  Buffer<float> distances_;
  Buffer<device::GatherRecord> recordBuffer_;
  using Parameters = Buffer<device::GatherParameters>;
  using Receivers = Buffer<device::Receiver>;
  Kernel<Parameters, Receivers, Buffer<device::Ray>> generate_;
  Kernel<std::uint32_t, Buffer<device::Hit>, Buffer<float>> store_;
  Kernel<Parameters, Receivers, Buffer<float>, Buffer<float>, Buffer<device::GatherRecord>> sum_;
};

}  // namespace prelight
