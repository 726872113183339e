// Marks functions that are called at every step, or take and return large structures: compilers would otherwise call
// rather than inline them and pass structures through memory. Functions that no kernel calls are left out of its
// program.
#ifndef PRELIGHT_CORE_INLINE_H
#define PRELIGHT_CORE_INLINE_H

#define PRELIGHT_INLINE static inline __attribute__((always_inline))

#endif
