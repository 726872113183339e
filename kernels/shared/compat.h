// The only file that distinguishes host from device. Shared headers include it first and use only the types
// named here.
#ifndef PRELIGHT_SHARED_COMPAT_H
#define PRELIGHT_SHARED_COMPAT_H

#ifdef __OPENCL_C_VERSION__
#define PRELIGHT_SHARED_BEGIN
#define PRELIGHT_SHARED_END
#else
#include <cstdint>
#define PRELIGHT_SHARED_BEGIN  \
  namespace prelight::device { \
  using uint = std::uint32_t;  \
  using uchar = std::uint8_t;  \
  using ushort = std::uint16_t;
#define PRELIGHT_SHARED_END }
#endif

#endif
