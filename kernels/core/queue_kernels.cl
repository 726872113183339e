// Options: PRELIGHT_ITEM_WORDS, of what moveListed moves.
// Lists what a step has marked to go on, in the order of its numbers, whichever work-item came first: results and the
// neighbours that rays are traced with do not depend on the device. Up to four kinds of mark, a bit each.
#include "shared/queue_types.h"

uint4 kindsOf(uchar mark) { return ((uint4)(mark) >> (uint4)(0, 1, 2, 3)) & 1u; }

// A run of marks a work-item. marks [count] -> counts [run][kind]. Next: startRuns.
__kernel void countMarks(const uint count, __global const uchar* marks, __global uint4* counts) {
  const uint run = (uint)get_global_id(0);
  const uint first = run * PRELIGHT_QUEUE_RUN;
  if (first >= count) return;
  uint4 sum = (uint4)(0u);
  for (uint i = first; i < min(count, first + PRELIGHT_QUEUE_RUN); ++i) sum += kindsOf(marks[i]);
  counts[run] = sum;
}

// One work-item. counts [run][kind] -> where each run begins in its kind's list, and all of them at the end, [runs + 1][kind].
// Next: listMarked.
__kernel void startRuns(const uint runs, __global uint4* counts) {
  if (get_global_id(0) != 0) return;
  uint4 start = (uint4)(0u);
  for (uint run = 0; run < runs; ++run) {
    const uint4 own = counts[run];
    counts[run] = start;
    start += own;
  }
  counts[runs] = start;
}

// A run a work-item. marks [count], starts [run][kind] -> lists [kind][most], ascending.
__kernel void listMarked(const uint count, const uint most, __global const uchar* marks, __global const uint4* starts,
                         __global uint* lists) {
  const uint run = (uint)get_global_id(0);
  const uint first = run * PRELIGHT_QUEUE_RUN;
  if (first >= count) return;
  uint4 place = starts[run] + (uint4)(0, most, 2 * most, 3 * most);
  for (uint i = first; i < min(count, first + PRELIGHT_QUEUE_RUN); ++i) {
    const uint4 kinds = kindsOf(marks[i]);
    if (kinds.x != 0u) lists[place.x] = i;
    if (kinds.y != 0u) lists[place.y] = i;
    if (kinds.z != 0u) lists[place.z] = i;
    if (kinds.w != 0u) lists[place.w] = i;
    place += kinds;
  }
}

#ifdef PRELIGHT_ITEM_WORDS
typedef struct Item {
  uint words[PRELIGHT_ITEM_WORDS];
} Item;

// A listed item a work-item. lists: from firstListed on those that move, from their own places after `from` to places close
// together after `to`.
__kernel void moveListed(const uint count, const uint firstListed, __global const uint* lists, const uint from,
                         __global const Item* items, const uint to, __global Item* moved) {
  const size_t i = get_global_id(0);
  if (i < count) moved[to + i] = items[from + lists[firstListed + i]];
}
#endif
