#include "base/work_share.h"

#include <algorithm>
#include <utility>

namespace prelight {

SharedLoop::SharedLoop(WorkPart& part, std::string_view stage)
    : keeper_(part.keeper()), share_(keeper_ != nullptr ? keeper_->share() : nullptr), stage_(stage) {
  if (share_ == nullptr) return;
  loop_ = part.name() + ' ' + stage_;
  if (share_->begin(loop_, stage_)) return;
  keeper_->save(true);
  throw StageEnd{std::move(stage_)};
}

std::uint64_t SharedLoop::pieceSize(std::uint64_t total, std::uint64_t least, std::uint64_t most) {
  constexpr std::uint64_t pieces = 256;
  return std::clamp<std::uint64_t>((total + pieces - 1) / pieces, least, std::max(least, most));
}

void SharedLoop::end() {
  if (share_ != nullptr && !share_->end()) throw StageEnd{std::move(stage_)};
}

}  // namespace prelight
