// Work queues: compaction of the items that go on from step to step.
#ifndef PRELIGHT_SHARED_QUEUE_TYPES_H
#define PRELIGHT_SHARED_QUEUE_TYPES_H

#include "shared/compat.h"

#define PRELIGHT_QUEUE_RUN 256u  ///< marks per work-item
#define PRELIGHT_QUEUE_KINDS 4u
#define PRELIGHT_QUEUE_FEW 4096u  ///< up to so many marks, one work-item is faster than three launches

PRELIGHT_SHARED_BEGIN

/// Up to two arrays whose listed items are moved.
typedef struct QueueMove {
  uint count;        ///< listed items that move
  uint firstListed;  ///< index of the first in the lists
  uint words[2];     ///< words per item; 0: no such array
  uint from[2];      ///< index in the array from which items are counted
  uint to[2];        ///< index to which the first item moves
} QueueMove;

PRELIGHT_SHARED_END

#endif
