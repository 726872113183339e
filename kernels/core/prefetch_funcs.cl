// Hints that memory is soon read, where the compiler has an instruction for them.
#ifndef PRELIGHT_CORE_PREFETCH_FUNCS_CL
#define PRELIGHT_CORE_PREFETCH_FUNCS_CL

#if !defined(PRELIGHT_PORTABLE_LANES) && defined(__has_builtin)
#if __has_builtin(__builtin_prefetch)
#define PRELIGHT_PREFETCH
#endif
#endif

// Asks for the cache lines of `bytes` from `address` on.
void prefetchBytes(__global const char* address, uint bytes) {
#ifdef PRELIGHT_PREFETCH
  for (uint at = 0; at < bytes; at += 64) __builtin_prefetch(address + at);
#endif
}

#endif
