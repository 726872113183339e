// Queues of work: what goes on from step to step.
#ifndef PRELIGHT_SHARED_QUEUE_TYPES_H
#define PRELIGHT_SHARED_QUEUE_TYPES_H

#define PRELIGHT_QUEUE_RUN 256u  ///< marks that a work-item counts and lists
#define PRELIGHT_QUEUE_KINDS 4u

#endif
