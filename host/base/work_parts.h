#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/state_log.h"
#include "base/work_share.h"

namespace prelight {

/// One of `count` shares of a stage, `index` from 1.
struct SliceChoice {
  std::uint32_t index = 1;
  std::uint32_t count = 1;
};

/// The title of a slice's file.
struct PartTitle {
  std::string loop, stage;
  SliceChoice slice;
  std::vector<std::string> arguments;  ///< of the command that wrote it, without those that name the slice
};

/// Returns the title of a slice's file. Throws InputError where it is none.
PartTitle readPartTitle(const std::filesystem::path& path);

/// Computes a slice of the first stage that is reached, and writes its pieces to a file, a StateLog. The
/// process ends with the stage. Pieces that the file already has are not computed again.
class WorkSlice final : public WorkShare {
 public:
  /// `work`: the kind of the work's state. `arguments`: as in PartTitle. Throws as StateLog::open() does.
  WorkSlice(const std::filesystem::path& path, const std::string& work, const StateKey& key,
            const SliceChoice& choice, std::vector<std::string> arguments);

  /// Commits pieces that are not: the process is being interrupted.
  ~WorkSlice() override;

  bool begin(const std::string& loop, std::string_view stage) override;
  PieceSource sourceOf(const std::string& loop, const WorkPiece& piece) override;
  bool givesAway() const override { return true; }
  void write(const std::string& loop, const WorkPiece& piece, std::span<const std::byte> result) override;
  bool end() override;

  const std::filesystem::path& path() const { return log_.path(); }
  const SliceChoice& choice() const { return title_.slice; }
  const std::string& stage() const { return title_.stage; }
  std::uint64_t pieces() const { return pieces_; }  ///< of the stage, so far
  std::uint64_t own() const { return own_; }        ///< of them, in the file
  std::uint64_t known() const { return known_; }    ///< of those, computed by an earlier process

 private:
  using Clock = std::chrono::steady_clock;

  void commit();

  std::mutex guard_;  ///< of the log: pieces may be computed by another thread than asks for them
  StateLog log_;
  PartTitle title_;
  Clock::time_point committed_ = Clock::now();
  std::uint64_t uncommitted_ = 0;  ///< pieces since then
  std::uint64_t pieces_ = 0, own_ = 0, known_ = 0;
};

/// Lists the stages of work that one process does as a whole.
class StageList final : public WorkShare {
 public:
  bool begin(const std::string& /*loop*/, std::string_view stage) override {
    stages_.emplace_back(stage);
    return true;
  }
  PieceSource sourceOf(const std::string& /*loop*/, const WorkPiece& /*piece*/) override {
    return PieceSource::Here;
  }

  const std::vector<std::string>& stages() const { return stages_; }

 private:
  std::vector<std::string> stages_;
};

/// Takes pieces from the files of slices, in any order and number. What they lack of a stage is computed
/// here. The process ends before a stage that no file is of.
class GivenParts final : public WorkShare {
 public:
  /// `anyDevice`: the parts may come from another device than the key's. Throws InputError for files that are
  /// no parts, and UsageError for parts of other work.
  GivenParts(const std::vector<std::filesystem::path>& paths, const std::string& work, const StateKey& key,
             bool anyDevice);

  bool begin(const std::string& loop, std::string_view stage) override;
  PieceSource sourceOf(const std::string& loop, const WorkPiece& piece) override;
  StateReader read(const std::string& loop, const WorkPiece& piece) override;

  const std::vector<PartTitle>& titles() const { return titles_; }
  std::uint64_t given() const { return given_; }                      ///< pieces taken from files
  std::uint64_t here() const { return here_; }                        ///< pieces that no file had
  const std::vector<std::string>& stages() const { return stages_; }  ///< that files were of

 private:
  const StateLog* holderOf(const std::string& name) const;

  std::vector<StateLog> logs_;
  std::vector<PartTitle> titles_;
  std::vector<std::string> stages_;
  std::uint64_t given_ = 0, here_ = 0;
};

}  // namespace prelight
