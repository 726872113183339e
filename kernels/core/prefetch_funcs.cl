// Prefetch hints, where the compiler has an instruction for them.
#ifndef PRELIGHT_CORE_PREFETCH_FUNCS_CL
#define PRELIGHT_CORE_PREFETCH_FUNCS_CL

// The instruction takes an address of the single address space of CPUs. GPUs have several spaces, and their compilers
// offer the builtin too, so its presence is not enough.
#if !defined(PRELIGHT_PORTABLE_LANES) && defined(__has_builtin) && (defined(__x86_64__) || defined(__aarch64__))
#if __has_builtin(__builtin_prefetch)
#define PRELIGHT_PREFETCH
#endif
#endif

// Prefetches the cache lines of `bytes` bytes from `address` on.
void prefetchBytes(__global const char* address, uint bytes) {
#ifdef PRELIGHT_PREFETCH
  for (uint at = 0; at < bytes; at += 64) __builtin_prefetch((const void*)(size_t)(address + at));
#endif
}

#endif
