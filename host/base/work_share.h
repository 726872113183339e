#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/kept_work.h"
#include "base/state_file.h"

namespace prelight {

/// Elements [first, first + count) of what a loop computes, which do not depend on the loop's other elements.
struct WorkPiece {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// Where the result of a piece comes from.
enum class PieceSource : std::uint8_t {
  Here,       ///< this process computes it
  Given,      ///< another process has computed it
  Elsewhere,  ///< another process computes it, and this one goes without
};

/// Thrown where a process has done its share of a stage and cannot go on without the shares of others.
struct StageEnd {
  std::string stage;
};

/// Divides long work among processes, each of which runs the same functions from the same state. A loop whose
/// pieces are divided is a stage: what follows it needs all of its pieces.
class WorkShare {
 public:
  virtual ~WorkShare() = default;

  /// Begins a stage. Returns false if this process has to end before it.
  virtual bool begin(const std::string& loop, std::string_view stage) = 0;

  /// Asked once for each piece of the stage, in their order. Another thread may read and write meanwhile.
  virtual PieceSource sourceOf(const std::string& loop, const WorkPiece& piece) = 0;

  /// Returns the result of a given piece. By default none is given.
  virtual StateReader read(const std::string& /*loop*/, const WorkPiece& /*piece*/) { return {{}, {}}; }

  /// Returns whether results are for other processes: write() takes them, and this process goes without.
  virtual bool givesAway() const { return false; }
  virtual void write(const std::string& /*loop*/, const WorkPiece& /*piece*/,
                     std::span<const std::byte> /*result*/) {}

  /// Ends a stage. Returns false if the process ends with it, because it lacks pieces.
  virtual bool end() { return true; }
};

/// A loop over independent pieces of work, which processes divide among them if the work's keeper has a
/// WorkShare; without one, every piece is computed here.
class SharedLoop {
 public:
  /// `part`: what the loop is the work of. `stage`: the loop's name for people, different for each loop of
  /// the part. Throws StageEnd.
  SharedLoop(WorkPart& part, std::string_view stage);

  bool divided() const { return share_ != nullptr; }

  /// Returns how many elements make a piece of a loop over `total` of them: a 256th, within the bounds. All
  /// processes divide a loop in the same way, however many they are.
  static std::uint64_t pieceSize(std::uint64_t total, std::uint64_t least, std::uint64_t most);

  /// Calls compute() or takes the result from another process by state(reader). Returns false where there is
  /// no result, because other processes need it and this one does not. `state` is as for a WorkPart.
  template <typename Compute, typename State>
  bool run(const WorkPiece& piece, const Compute& compute, const State& state) {
    if (share_ == nullptr) {
      compute();
      return true;
    }
    switch (sourceOf(piece)) {
      case PieceSource::Elsewhere:
        return false;
      case PieceSource::Given:
        take(piece, state);
        return true;
      case PieceSource::Here:
        break;
    }
    keeper_->divide(nullptr);  // a piece is not divided further
    compute();
    keeper_->divide(share_);
    return give(piece, state);
  }

  /// The steps of run(), for pieces whose computation begins and ends apart. give() returns whether the
  /// result is needed here, too.
  PieceSource sourceOf(const WorkPiece& piece) const {
    return share_ != nullptr ? share_->sourceOf(loop_, piece) : PieceSource::Here;
  }
  template <typename State>
  void take(const WorkPiece& piece, const State& state) const {
    StateReader reader = share_->read(loop_, piece);
    state(reader);
    reader.require(reader.rest().empty());
  }
  template <typename State>
  bool give(const WorkPiece& piece, const State& state) const {
    if (share_ == nullptr || !share_->givesAway()) return true;
    StateWriter writer;
    state(writer);
    share_->write(loop_, piece, writer.payload());
    return false;
  }

  /// Ends the loop. Throws StageEnd if pieces are missing here.
  void end();

 private:
  WorkKeeper* keeper_;
  WorkShare* share_;  ///< nullptr: nothing is divided
  std::string loop_, stage_;
};

}  // namespace prelight
