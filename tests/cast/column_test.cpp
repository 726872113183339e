#include "cast/column.h"

#include <gtest/gtest.h>

#include "cast/caster.h"
#include "cast/scene_cast.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr std::uint32_t fewRays = 16;  // per receiver

/// Where receivers are along x: a quantity that the cast knows nothing of.
class PlaceColumn final : public FittedColumn {
 public:
  PlaceColumn() : FittedColumn(0, 1) {}

  void addTo(VertexFit& fit, const SeenBlock& block, std::vector<double>& rows) const override {
    rows.clear();
    for (const device::Receiver& receiver : block.receivers) rows.push_back(receiver.position[0]);
    fit.add(block.samples, rows);
  }
};

/// Counts what becomes of blocks of one side.
class CountingColumn final : public Column {
 public:
  explicit CountingColumn(Side side) : side_(side) {}

  bool castFrom(Side side) const override { return side == side_; }
  void start(const CastBlock& block) override { started += block.receivers; }
  void finish(const CastBlock& block, ColumnRows& rows) override {
    rows.rows.assign(block.receivers, std::byte{7});
  }
  std::unique_ptr<ColumnSums> makeSums(const SideShape& /*side*/) override {
    return std::make_unique<Sums>(*this);
  }

  std::size_t started = 0, added = 0;  ///< receivers

 private:
  class Sums final : public ColumnSums {
   public:
    explicit Sums(CountingColumn& column) : column_(column) {}

    void add(const SeenBlock& block) override {
      for (const std::byte row : block.rows.of(column_).rows) column_.added += row == std::byte{7} ? 1 : 0;
    }
    void save(StateWriter& /*state*/) const override {}
    void load(StateReader& /*state*/, const SeenCounts& /*counts*/) override {}

   private:
    CountingColumn& column_;
  };

  Side side_;
};

/// A square that is cast from with columns of the test's own.
class CastGround : public ::testing::Test {
 protected:
  void cast(std::vector<Column*> further) {
    further.insert(further.begin(), &hemisphere_);
    CastOptions options;
    options.raysPerReceiver = fewRays;
    options.overlaps = true;
    caster_ = std::make_unique<Caster>(scene_, tracer_, options, std::move(further));
    schedule_.raysPerReceiver = fewRays;
    schedule_.receiversPerPass = 4.0 * mesh_.slotCount();
    cast_ = std::make_unique<SceneCast>(scene_, mesh_, *caster_, schedule_,
                                        SceneCastOptions{hemisphere_, nullptr, nullptr, {}, {}});
    Progress progress;
    WorkPart part(progress, "cast", keptBy(*cast_));
    cast_->run(progress, part);
    part.finish();
    cast_->finish(progress);
  }

  CompiledScene scene_ = test::ground(8, 2.0f);
  FitMesh mesh_ = makeFitMesh(scene_);
  Tracer tracer_{scene_, test::sharedDevice()};
  HemisphereColumn hemisphere_{0};
  Schedule schedule_;
  std::unique_ptr<Caster> caster_;
  std::unique_ptr<SceneCast> cast_;
};

TEST_F(CastGround, ColumnThatTheCastDoesNotKnow_IsFittedToVertices) {
  PlaceColumn places;
  cast({&places});
  const std::vector<float> fitted = places.fitOn(cast_->front().sums()).solve(defaultSmoothing);
  ASSERT_EQ(fitted.size(), mesh_.slotCount());
  for (std::uint32_t v = 0; v < scene_.vertexCount(); ++v)
    EXPECT_NEAR(fitted[mesh_.slotOfVertex[v]], scene_.positions[v].x, 0.03f) << v;
}

TEST_F(CastGround, RowsOfEveryBlock_ReachTheSumsOfTheirSide) {
  CountingColumn fronts(Side::Front), backs(Side::Back);
  cast({&fronts, &backs});
  EXPECT_EQ(fronts.started, cast_->receivers());
  EXPECT_EQ(fronts.added, cast_->receivers());
  EXPECT_EQ(backs.started + backs.added, 0u);
}

}  // namespace
}  // namespace prelight
