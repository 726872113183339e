#include "gi/record_gather.h"

namespace prelight {

RecordGather::RecordGather(const FinalGather& gather) {
  DeviceContext& device = gather.device();
  distances_ = Buffer<float>(device, std::size_t{gather.receiversAtOnce()} * gather.raysPerReceiver());
  recordBuffer_ = Buffer<device::GatherRecord>(device, gather.receiversAtOnce());
  const char* file = "gather/record_kernels.cl";
  generate_ = {device, file, {}, "generateRecordRays"};
  store_ = {device, file, {}, "storeDistances"};
  sum_ = {device, file, {}, "sumRecords"};
}

void RecordGather::makeRays(const GatherBlock& block) {
  generate_.launch(block.rayCount, block.parameters, block.receivers, block.rays);
}

void RecordGather::meet(const GatherBlock& block) {
  store_.launch(block.rayCount, static_cast<std::uint32_t>(block.rayCount), block.hits, distances_);
}

void RecordGather::sum(const GatherBlock& block) {
  sum_.launch(block.count, block.parameters, block.receivers, block.radiances, distances_, recordBuffer_);
  const std::size_t before = records_.size();
  records_.resize(before + block.count);
  recordBuffer_.read(std::span(&records_[before], block.count));
}

}  // namespace prelight
