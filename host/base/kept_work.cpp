#include "base/kept_work.h"

#include <algorithm>
#include <new>
#include <utility>

#include "base/work_share.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr double mostSeconds = 1e9;  // clocks count to 292 years

/// The append-only arrays of a part, stored as separate records.
class PartArrays final : public GrownArrays {
 public:
  enum class Pass { Arrays, Rest };

  PartArrays(StateLog& log, const std::string& part, Pass pass) : log_(log), part_(part), pass_(pass) {}

  /// Writes the array or, in the second pass, requires that it was written in the first: the rest of the
  /// state is being written then, and the log accepts only one record at a time.
  void keep(std::uint64_t epoch, std::uint64_t count, std::size_t elementSize,
            const ReadElements& read) override {
    const std::string name = next();
    if (pass_ == Pass::Arrays) return log_.writeArray(name, epoch, count, elementSize, read);
    if (!log_.hasArray(name, epoch, count, elementSize))
      throw Error(ExitCode::RuntimeFailure, part_, "it changed while its state was written", "report this");
  }
  bool fetch(std::uint64_t count, std::size_t elementSize, const WriteElements& write) override {
    return log_.readArray(next(), count, elementSize, write);
  }

 private:
  std::string next() { return part_ + "#" + std::to_string(number_++); }

  StateLog& log_;
  const std::string& part_;
  Pass pass_;
  int number_ = 0;
};

std::string inStep(const std::string& part, std::uint64_t step) {
  return part + "[" + std::to_string(step) + "]/";
}

double secondsFrom(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

WorkKeeper::WorkKeeper(StateLog log, double mostUnkept, bool readOnly)
    : log_(std::move(log)),
      readOnly_(readOnly),
      mostUnkept_(mostUnkept),
      secondsBefore_(log_.seconds()),
      hasState_(!log_.names().empty()) {
  if (!(secondsBefore_ >= 0.0 && secondsBefore_ <= mostSeconds)) StateReader(log_.path(), {}).damaged();
}

double WorkKeeper::seconds() const { return secondsBefore_ + secondsFrom(start_); }

std::string WorkKeeper::nameOfNext(std::string_view name) {
  std::uint32_t& children = parts_.empty() ? rootChildren_ : parts_.back()->children_;
  const std::string within = parts_.empty() ? "" : inStep(parts_.back()->name_, parts_.back()->step_);
  return within + std::to_string(children++) + ":" + std::string(name);
}

void WorkKeeper::load(WorkPart& part) {
  if (!log_.has(part.name_)) return;
  PartArrays arrays(log_, part.name_, PartArrays::Pass::Arrays);
  StateReader reader(log_.path(), log_.read(part.name_), &arrays);
  reader.value(part.step_);
  reader.value(part.finished_);
  if (!part.finished_ && share_ != nullptr && share_->givesAway()) reader.setPartial();
  part.load_(reader);
  reader.require(reader.partial() || reader.rest().empty());
  part.keptStep_ = part.step_;
  part.kept_ = true;
}

/// Writes a part: first its arrays, because the rest of the state is written as one record.
void WorkKeeper::write(WorkPart& part) {
  PartArrays arrays(log_, part.name_, PartArrays::Pass::Arrays);
  PartArrays known(log_, part.name_, PartArrays::Pass::Rest);
  StateWriter growing(arrays);
  part.save_(growing);
  log_.write(part.name_, [&](const StateWriter::Sink& sink) {
    StateWriter writer(sink, &known);
    writer.value(part.step_);
    writer.value(part.finished_);
    part.save_(writer);
    writer.flush();
  });
  const std::uint64_t end = part.finished_ ? part.step_ + 1 : part.step_;
  for (std::uint64_t step = part.keptStep_; step < end; ++step) log_.erase(inStep(part.name_, step));
}

/// Commits what writeAll writes. Returns false if that failed.
bool WorkKeeper::commit(const std::function<void()>& writeAll) {
  if (readOnly_) return false;
  try {
    writeAll();
    log_.commit(seconds());
    failure_.clear();
    hasState_ = true;
    return true;
  } catch (const Error& error) {
    failure_ = error.what();
  } catch (const std::bad_alloc&) {
    failure_ = "out of memory";
  }
  log_.rollBack();
  return false;
}

void WorkKeeper::save(bool always) {
  const auto changed = [](const WorkPart* part) { return part->changed_; };
  if (always || std::any_of(parts_.begin(), parts_.end(), changed)) saveChanged();
}

/// Returns false where nothing could be kept.
bool WorkKeeper::saveChanged() {
  const bool kept = commit([&] {
    for (WorkPart* part : parts_)
      if (part->changed_) write(*part);
  });
  if (!kept) return false;
  for (WorkPart* part : parts_) {
    part->kept_ = part->kept_ || part->changed_;
    part->changed_ = false;
    part->keptStep_ = part->step_;
  }
  return true;
}

/// The parts around it are kept along with it: what it did may depend on the state of their step, such as
/// the length of a block that a clock has decided. Where work is divided, each process would have to repeat
/// what is not kept.
void WorkKeeper::finish(WorkPart& part, bool always) {
  const double own = secondsFrom(part.born_);
  const bool worthwhile = always || share_ != nullptr || part.kept_ ||
                          log_.hasAny(inStep(part.name_, part.step_)) ||
                          unkept_ - part.unkeptInside_ + own > mostUnkept_;
  unkept_ -= part.unkeptInside_;
  part.changed_ = true;
  if (worthwhile && saveChanged()) return;
  unkept_ += own;
  if (parts_.size() > 1) parts_[parts_.size() - 2]->unkeptInside_ += own;
}

WorkPart::WorkPart(WorkKeeper* keeper, std::string_view name, std::function<void(StateWriter&)> save,
                   std::function<void(StateReader&)> load)
    : keeper_(keeper != nullptr && keeper->ownsThisThread() ? keeper : nullptr),
      save_(std::move(save)),
      load_(std::move(load)) {
  if (keeper_ == nullptr) return;
  name_ = keeper_->nameOfNext(name);
  keeper_->load(*this);
  keeper_->parts_.push_back(this);
}

WorkPart::~WorkPart() {
  if (keeper_ != nullptr) keeper_->parts_.pop_back();
}

void WorkPart::advance() {
  if (keeper_ == nullptr) return;
  ++step_;
  children_ = 0;
  changed_ = true;
  keeper_->unkept_ -= unkeptInside_;
  unkeptInside_ = 0.0;
}

void WorkPart::finish(bool always) {
  if (keeper_ == nullptr || finished_) return;
  finished_ = true;
  keeper_->finish(*this, always);
}

}  // namespace prelight
