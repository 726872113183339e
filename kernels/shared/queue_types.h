// Queues of work: what goes on from step to step.
#ifndef PRELIGHT_SHARED_QUEUE_TYPES_H
#define PRELIGHT_SHARED_QUEUE_TYPES_H

#include "shared/compat.h"

#define PRELIGHT_QUEUE_RUN 256u  ///< marks that a work-item counts and lists
#define PRELIGHT_QUEUE_KINDS 4u
#define PRELIGHT_QUEUE_FEW 4096u  ///< marks that one work-item lists sooner than three launches do

PRELIGHT_SHARED_BEGIN

/// What moves with listed items: up to two arrays of items.
typedef struct QueueMove {
  uint count;        ///< listed items that move
  uint firstListed;  ///< in the lists
  uint words[2];     ///< of an item; 0: no such array
  uint from[2];      ///< place that items' own places are counted from
  uint to[2];        ///< place of the first
} QueueMove;

PRELIGHT_SHARED_END

#endif
