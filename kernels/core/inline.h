// Marks functions that are called at every step, or take and return large structures: compilers would rather call than copy,
// and pass structures through memory then. What no kernel calls is left out of its program.
#ifndef PRELIGHT_CORE_INLINE_H
#define PRELIGHT_CORE_INLINE_H

#define PRELIGHT_INLINE static inline __attribute__((always_inline))

#endif
