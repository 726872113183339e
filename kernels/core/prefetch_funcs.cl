// Hints that memory is soon read, where the compiler has an instruction for them.
#ifndef PRELIGHT_CORE_PREFETCH_FUNCS_CL
#define PRELIGHT_CORE_PREFETCH_FUNCS_CL

// The instruction takes an address of the one space that CPUs have. GPUs know several, and compilers for them have the
// builtin too.
#if !defined(PRELIGHT_PORTABLE_LANES) && defined(__has_builtin) && (defined(__x86_64__) || defined(__aarch64__))
#if __has_builtin(__builtin_prefetch)
#define PRELIGHT_PREFETCH
#endif
#endif

// Asks for the cache lines of `bytes` from `address` on.
void prefetchBytes(__global const char* address, uint bytes) {
#ifdef PRELIGHT_PREFETCH
  for (uint at = 0; at < bytes; at += 64) __builtin_prefetch((const void*)(size_t)(address + at));
#endif
}

#endif
