#include "techniques/glossy/stored_receivers.h"

#include "cast/side_sums.h"

namespace prelight {

namespace {

class ListedReceivers final : public ColumnSums {
 public:
  explicit ListedReceivers(const SideShape& side) : triangles_(side.scene.triangleCount()) {}

  const std::vector<device::Receiver>& receivers() const { return receivers_; }

  void add(const SeenBlock& block) override {
    receivers_.insert(receivers_.end(), block.receivers.begin(), block.receivers.end());
  }

  void save(StateWriter& state) const override { state.growing(receivers_); }

  void load(StateReader& state, const SeenCounts& counts) override {
    state.growing(receivers_);
    state.require(receivers_.size() == counts.stored);
    for (const device::Receiver& receiver : receivers_) {
      state.require(receiver.triangle < triangles_);
      for (const float* vector : {receiver.position, receiver.normal, receiver.geometricNormal})
        state.requireFinite(std::span(vector, 3));
    }
  }

 private:
  std::uint32_t triangles_;
  std::vector<device::Receiver> receivers_;
};

}  // namespace

std::unique_ptr<ColumnSums> StoredReceivers::makeSums(const SideShape& side) {
  return std::make_unique<ListedReceivers>(side);
}

const std::vector<device::Receiver>& StoredReceivers::receiversOn(const SideSums& side) const {
  return static_cast<const ListedReceivers&>(side.of(*this)).receivers();
}

}  // namespace prelight
