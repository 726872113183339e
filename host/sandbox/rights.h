#pragma once

namespace prelight {

/// Gives up, for good, the calling process's rights to all but reading and writing what it has open and to
/// its own memory: no file is opened, no program or process started, no socket made, no other process
/// signalled, no memory made executable; whatever tries so is told that it is not permitted. Bounds its
/// processor time to two minutes, beyond which it is killed. The process must have one thread. Returns false
/// where the system has no such filter; the bound on time holds all the same.
bool giveUpRights();

}  // namespace prelight
