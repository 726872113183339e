#include "base/work_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "prelight/error.h"

namespace prelight {

namespace {

constexpr const char* titleRecord = "title";
constexpr auto betweenCommits = std::chrono::seconds(10);

std::string kindOf(const std::string& work) { return "part of a " + work; }

std::string pieceName(const std::string& loop, const WorkPiece& piece) {
  return fmt::format("{} {}+{}", loop, piece.first, piece.count);
}

/// Writes or reads a title, in one order for both.
template <typename State>
void exchangeTitle(State& state, PartTitle& title) {
  auto arguments = static_cast<std::uint32_t>(title.arguments.size());
  state.text(title.loop);
  state.text(title.stage);
  state.value(title.slice);
  state.value(arguments);
  for (std::uint32_t i = 0; i < arguments; ++i) {
    if (i == title.arguments.size()) title.arguments.emplace_back();
    state.text(title.arguments[i]);
  }
  state.require(title.slice.index >= 1 && title.slice.index <= title.slice.count);
}

void writeTitle(StateLog& log, PartTitle title) {
  log.write(titleRecord, [&](const StateWriter::Sink& sink) {
    StateWriter state(sink);
    exchangeTitle(state, title);
    state.flush();
  });
}

PartTitle readTitle(const StateLog& log) {
  StateReader state(log.path(), log.read(titleRecord));
  PartTitle title;
  exchangeTitle(state, title);
  state.require(state.rest().empty());
  return title;
}

/// Opens a file whose pieces are to be read.
StateLog openPart(const std::filesystem::path& path) {
  std::optional<StateLog> log = StateLog::openAny(path, StateLog::Access::Read);
  if (!log) throw InputError(path.string(), "there is no such file", "name files that slices have written");
  if (!log->kind().starts_with(kindOf("")) || !log->has(titleRecord))
    throw InputError(path.string(), "is not the work of a slice", "name files that slices have written");
  return std::move(*log);
}

}  // namespace

WorkSlice::WorkSlice(const std::filesystem::path& path, const std::string& work, const StateKey& key,
                     const SliceChoice& choice, std::vector<std::string> arguments)
    : log_([&] {
        std::optional<StateLog> known = StateLog::open(path, kindOf(work), key);
        return known ? std::move(*known) : StateLog(path, kindOf(work), key);
      }()),
      title_{{}, {}, choice, std::move(arguments)} {
  if (!log_.has(titleRecord)) return;
  const PartTitle known = readTitle(log_);
  title_.loop = known.loop;
  title_.stage = known.stage;
}

WorkSlice::~WorkSlice() {
  try {
    if (uncommitted_ > 0) commit();
  } catch (const std::exception&) {  // what was committed before stays
  }
}

bool WorkSlice::begin(const std::string& loop, std::string_view stage) {
  if (!title_.loop.empty() && title_.loop != loop)
    throw UsageError(
        log_.path().string(),
        fmt::format("it holds pieces of the stage {}, and the next one is {}", title_.stage, stage),
        "write the slice of another stage to another file");
  title_.loop = loop;
  title_.stage = stage;
  writeTitle(log_, title_);
  commit();
  return true;
}

/// Each slice has one piece of as many in a row, not always at the same place: what lies side by side takes
/// about as long.
PieceSource WorkSlice::sourceOf(const std::string& loop, const WorkPiece& piece) {
  const std::uint64_t number = pieces_++, count = title_.slice.count;
  if ((number + number / count) % count != title_.slice.index - 1) return PieceSource::Elsewhere;
  ++own_;
  const std::scoped_lock lock(guard_);
  if (!log_.has(pieceName(loop, piece))) return PieceSource::Here;
  ++known_;
  return PieceSource::Elsewhere;
}

void WorkSlice::write(const std::string& loop, const WorkPiece& piece, std::span<const std::byte> result) {
  const std::scoped_lock lock(guard_);
  try {
    log_.write(pieceName(loop, piece), [&](const StateWriter::Sink& sink) { sink(result); });
    ++uncommitted_;
    if (Clock::now() - committed_ > betweenCommits) commit();
  } catch (...) {
    log_.rollBack();
    uncommitted_ = 0;
    throw;
  }
}

bool WorkSlice::end() {
  commit();
  return false;
}

void WorkSlice::commit() {
  log_.commit(0.0);
  committed_ = Clock::now();
  uncommitted_ = 0;
}

PartTitle readPartTitle(const std::filesystem::path& path) { return readTitle(openPart(path)); }

GivenParts::GivenParts(const std::vector<std::filesystem::path>& paths, const std::string& work,
                       const StateKey& key, bool anyDevice) {
  const auto compared = [&](StateKey whole) {
    if (anyDevice) std::erase_if(whole, [](const auto& part) { return part.first == "device"; });
    return whole;
  };
  for (const std::filesystem::path& path : paths) {
    StateLog log = openPart(path);
    const StateKey found = compared(log.key()), expected = compared(key);
    if (log.kind() != kindOf(work) || found != expected)
      throw UsageError(path.string(),
                       log.kind() != kindOf(work)
                           ? fmt::format("got a {}, expected a {}", log.kind(), kindOf(work))
                           : fmt::format("it is of work with another {}", differencesOf(found, expected)),
                       "merge parts of the same work");
    titles_.push_back(readTitle(log));
    logs_.push_back(std::move(log));
  }
}

bool GivenParts::begin(const std::string& loop, std::string_view stage) {
  const bool known =
      std::any_of(titles_.begin(), titles_.end(), [&](const PartTitle& title) { return title.loop == loop; });
  if (known) stages_.emplace_back(stage);
  return known;
}

const StateLog* GivenParts::holderOf(const std::string& name) const {
  const auto holder =
      std::find_if(logs_.begin(), logs_.end(), [&](const StateLog& log) { return log.has(name); });
  return holder != logs_.end() ? &*holder : nullptr;
}

PieceSource GivenParts::sourceOf(const std::string& loop, const WorkPiece& piece) {
  const bool given = holderOf(pieceName(loop, piece)) != nullptr;
  ++(given ? given_ : here_);
  return given ? PieceSource::Given : PieceSource::Here;
}

StateReader GivenParts::read(const std::string& loop, const WorkPiece& piece) {
  const std::string name = pieceName(loop, piece);
  const StateLog& log = *holderOf(name);
  return {log.path(), log.read(name)};
}

}  // namespace prelight
