// Compaction of the items that a step has marked to go on, in ascending order whichever work-item came first, so that
// results and the neighbours with which rays are traced do not depend on the device. There are up to four kinds of
// marks, one bit each.
#include "shared/queue_types.h"

uint4 kindsOf(uchar mark) { return ((uint4)(mark) >> (uint4)(0, 1, 2, 3)) & 1u; }

void listKinds(uint4 kinds, uint4 place, uint item, __global uint* lists) {
  if (kinds.x != 0u) lists[place.x] = item;
  if (kinds.y != 0u) lists[place.y] = item;
  if (kinds.z != 0u) lists[place.z] = item;
  if (kinds.w != 0u) lists[place.w] = item;
}

// One work-item per run of marks. marks [count] -> counts [run][kind]. Next: startRuns.
__kernel void countMarks(const uint count, __global const uchar* marks, __global uint4* counts) {
  const uint run = (uint)get_global_id(0);
  const uint first = run * PRELIGHT_QUEUE_RUN;
  if (first >= count) return;
  uint4 sum = (uint4)(0u);
  for (uint i = first; i < min(count, first + PRELIGHT_QUEUE_RUN); ++i) sum += kindsOf(marks[i]);
  counts[run] = sum;
}

// One work-item. counts [run][kind] -> the start of each run in its kind's list and, at the end, the lists' lengths,
// [runs + 1][kind]. Next: listMarked.
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

// One work-item per run. marks [count], starts [run][kind] -> lists [kind][most], ascending.
__kernel void listMarked(const uint count, const uint most, __global const uchar* marks, __global const uint4* starts,
                         __global uint* lists) {
  const uint run = (uint)get_global_id(0);
  const uint first = run * PRELIGHT_QUEUE_RUN;
  if (first >= count) return;
  uint4 place = starts[run] + (uint4)(0, most, 2 * most, 3 * most);
  for (uint i = first; i < min(count, first + PRELIGHT_QUEUE_RUN); ++i) {
    const uint4 kinds = kindsOf(marks[i]);
    listKinds(kinds, place, i, lists);
    place += kinds;
  }
}

// One work-item. marks [count] -> lists [kind][most], ascending, and totals [kind], the lists' lengths.
__kernel void listFew(const uint count, const uint most, __global const uchar* marks, __global uint4* totals,
                      __global uint* lists) {
  if (get_global_id(0) != 0) return;
  const uint4 first = (uint4)(0, most, 2 * most, 3 * most);
  uint4 place = first;
  for (uint i = 0; i < count; ++i) {
    if (marks[i] == 0) continue;
    const uint4 kinds = kindsOf(marks[i]);
    listKinds(kinds, place, i, lists);
    place += kinds;
  }
  totals[0] = place - first;
}

void moveItem(uint words, __global const uint* item, __global uint* moved) {
  for (uint w = 0; w < words; ++w) moved[w] = item[w];
}

// One work-item per listed item: moves it from its own place to its place in the list.
__kernel void moveListed(const QueueMove move, __global const uint* lists, __global const uint* items, __global uint* moved,
                         __global const uint* more, __global uint* moreMoved) {
  const size_t i = get_global_id(0);
  if (i >= move.count) return;
  const size_t own = lists[move.firstListed + i];
  moveItem(move.words[0], items + (move.from[0] + own) * move.words[0], moved + (move.to[0] + i) * move.words[0]);
  moveItem(move.words[1], more + (move.from[1] + own) * move.words[1], moreMoved + (move.to[1] + i) * move.words[1]);
}
