// Preloaded library that makes calls of the system and of OpenCL fail. tests/cli/faults/fault_sampling_test.cpp says how often and where.
//
//   PRELIGHT_FAULT: "KIND NUMBER once|forever": the call with that number (from 1) fails, alone or with all later ones. KIND is
//       allocation, open, write, thread, rename, read, sync or device. Unset: nothing fails. A call of OpenCL that fails alone
//       finds no resources; those that fail for ever find the queue invalid, as after the loss of a device.
//   PRELIGHT_FAULT_SPARES: parts of file names of libraries, separated by colons. An allocation that such a library makes itself
//       does not fail alone: the next one of others fails in its place. Nor does a read of its own.
//   PRELIGHT_FAULT_COUNTS: an existing file of one 64-bit number of calls per kind, in that order, and one of failed calls.
//
// Calls are counted from main() on, in the program `prelight` alone. Calls that the C library makes internally are not counted.
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/uio.h>
#include <unistd.h>

enum Kind { ALLOCATION, OPEN, WRITE, THREAD, RENAME, READ, SYNC, DEVICE, KINDS };

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

static uint64_t* counts;  // [KINDS], then the number of failed calls.
static int armed, failingKind = KINDS, forever;
static uint64_t failingNumber;
static char spared[256];  // parts of file names, each followed by a zero; an empty one ends them

static const char* const kindNames[KINDS] = {"allocation", "open", "write", "thread", "rename", "read", "sync", "device"};

// Counts a call of a kind, and returns whether it is to fail.
static int fails(enum Kind kind) {
  if (!armed) return 0;
  const uint64_t number = __atomic_add_fetch(&counts[kind], 1, __ATOMIC_RELAXED);
  if ((int)kind != failingKind || number < failingNumber || (number > failingNumber && !forever)) return 0;
  __atomic_add_fetch(&counts[KINDS], 1, __ATOMIC_RELAXED);
  return 1;
}

static int belongsToSpared(void* caller) {
  Dl_info info;
  if (spared[0] == '\0' || dladdr(caller, &info) == 0 || info.dli_fname == NULL) return 0;
  for (const char* name = spared; *name != '\0'; name += strlen(name) + 1)
    if (strstr(info.dli_fname, name) != NULL) return 1;
  return 0;
}

static void* next(const char* name) { return dlsym(RTLD_NEXT, name); }

static void readFault(const char* text) {
  char kind[16], mode[16];
  unsigned long long number = 0;
  if (text == NULL || sscanf(text, "%15s %llu %15s", kind, &number, mode) != 3) return;
  for (int i = 0; i < KINDS; ++i)
    if (strcmp(kind, kindNames[i]) == 0) failingKind = i;
  failingNumber = number;
  forever = strcmp(mode, "forever") == 0;
}

static void readSpared(const char* names) {
  if (names == NULL) return;
  strncpy(spared, names, sizeof spared - 2);  // Two zeros are left at the end.
  for (char* c = spared; *c != '\0' || c[1] != '\0'; ++c)
    if (*c == ':') *c = '\0';
}

static void arm(void) {
  const char* path = getenv("PRELIGHT_FAULT_COUNTS");
  if (path == NULL || strncmp(program_invocation_short_name, "prelight", 8) != 0) return;
  readFault(getenv("PRELIGHT_FAULT"));
  readSpared(getenv("PRELIGHT_FAULT_SPARES"));
  int (*realOpen)(const char*, int, ...) = (int (*)(const char*, int, ...))next("open");
  const int descriptor = realOpen(path, O_RDWR | O_CLOEXEC);
  void* shared = mmap(NULL, (KINDS + 1) * sizeof(uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  close(descriptor);
  if (shared == MAP_FAILED) return;
  counts = shared;
  armed = 1;
}

static int (*realMain)(int, char**, char**);

static int armedMain(int count, char** arguments, char** environment) {
  arm();
  return realMain(count, arguments, environment);
}

int __libc_start_main(int (*main)(int, char**, char**), int count, char** arguments, void (*init)(void),
                      void (*fini)(void), void (*ldFini)(void), void* stackEnd) {
  realMain = main;
  int (*start)(int (*)(int, char**, char**), int, char**, void (*)(void), void (*)(void), void (*)(void), void*) =
      (int (*)(int (*)(int, char**, char**), int, char**, void (*)(void), void (*)(void), void (*)(void), void*))next(
          "__libc_start_main");
  return start(armedMain, count, arguments, init, fini, ldFini, stackEnd);
}

// ---- memory

static int noMemory(void* caller) {
  static int failedOnce;
  if (!armed) return 0;
  const uint64_t number = __atomic_add_fetch(&counts[ALLOCATION], 1, __ATOMIC_RELAXED);
  if (failingKind != ALLOCATION || number < failingNumber) return 0;
  if (!forever && (belongsToSpared(caller) || __atomic_exchange_n(&failedOnce, 1, __ATOMIC_RELAXED) != 0)) return 0;
  __atomic_add_fetch(&counts[KINDS], 1, __ATOMIC_RELAXED);
  errno = ENOMEM;
  return 1;
}

#define CALLER __builtin_return_address(0)
void* malloc(size_t bytes) { return noMemory(CALLER) ? NULL : __libc_malloc(bytes); }
void* calloc(size_t count, size_t bytes) { return noMemory(CALLER) ? NULL : __libc_calloc(count, bytes); }
void* realloc(void* old, size_t bytes) { return noMemory(CALLER) ? NULL : __libc_realloc(old, bytes); }
void* memalign(size_t alignment, size_t bytes) { return noMemory(CALLER) ? NULL : __libc_memalign(alignment, bytes); }
void* aligned_alloc(size_t alignment, size_t bytes) {
  return noMemory(CALLER) ? NULL : __libc_memalign(alignment, bytes);
}

int posix_memalign(void** memory, size_t alignment, size_t bytes) {
  const int before = errno;
  void* made = noMemory(CALLER) ? NULL : __libc_memalign(alignment, bytes);
  if (made == NULL) return ENOMEM;
  errno = before;
  *memory = made;
  return 0;
}

// ---- files

static int noFile(void) {
  if (!fails(OPEN)) return 0;
  errno = EMFILE;
  return 1;
}

// Defines a function that fails where `refuses` says so.
#define REFUSING(refuses, type, name, failure, parameters, arguments) \
  type name parameters {                                              \
    static type(*real) parameters;                                    \
    if (real == NULL) real = (type(*) parameters)next(#name);         \
    return refuses() ? failure : real arguments;                      \
  }

#define OPENING(...) REFUSING(noFile, __VA_ARGS__)

#define OPENING_WITH_MODE(name, parameters, arguments, last)          \
  int name parameters {                                               \
    static int(*real) parameters;                                     \
    if (real == NULL) real = (int(*) parameters)next(#name);          \
    va_list rest;                                                     \
    va_start(rest, last);                                             \
    const mode_t mode = (last & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0; \
    va_end(rest);                                                     \
    return noFile() ? -1 : real arguments;                            \
  }

OPENING_WITH_MODE(open, (const char* path, int flags, ...), (path, flags, mode), flags)
OPENING_WITH_MODE(open64, (const char* path, int flags, ...), (path, flags, mode), flags)
OPENING_WITH_MODE(openat, (int folder, const char* path, int flags, ...), (folder, path, flags, mode), flags)
OPENING_WITH_MODE(openat64, (int folder, const char* path, int flags, ...), (folder, path, flags, mode), flags)
OPENING(FILE*, fopen, NULL, (const char* path, const char* mode), (path, mode))
OPENING(FILE*, fopen64, NULL, (const char* path, const char* mode), (path, mode))
OPENING(int, mkostemp, -1, (char* pattern, int flags), (pattern, flags))
OPENING(int, mkstemp, -1, (char* pattern), (pattern))
OPENING(int, mkstemp64, -1, (char* pattern), (pattern))
OPENING(int, memfd_create, -1, (const char* name, unsigned int flags), (name, flags))
OPENING(int, pipe, -1, (int ends[2]), (ends))
OPENING(int, pipe2, -1, (int ends[2], int flags), (ends, flags))

// ---- writes

static int noRoom(void) {
  if (!fails(WRITE)) return 0;
  errno = ENOSPC;
  return 1;
}

#define WRITING(...) REFUSING(noRoom, __VA_ARGS__)

WRITING(ssize_t, write, -1, (int file, const void* bytes, size_t count), (file, bytes, count))
WRITING(ssize_t, writev, -1, (int file, const struct iovec* parts, int count), (file, parts, count))
WRITING(ssize_t, pwrite, -1, (int file, const void* bytes, size_t count, off_t at), (file, bytes, count, at))
WRITING(ssize_t, pwrite64, -1, (int file, const void* bytes, size_t count, off64_t at), (file, bytes, count, at))
WRITING(size_t, fwrite, 0, (const void* bytes, size_t size, size_t count, FILE* file), (bytes, size, count, file))
WRITING(int, fflush, EOF, (FILE* file), (file))

int fclose(FILE* file) {
  static int (*real)(FILE*);
  if (real == NULL) real = (int (*)(FILE*))next("fclose");
  const int refused = noRoom(), result = real(file);  // Unwritten data is lost, as on a full disk.
  if (refused) errno = ENOSPC;
  return refused ? EOF : result;
}

// ---- renaming

static int noName(void) {
  if (!fails(RENAME)) return 0;
  errno = EIO;
  return 1;
}

#define RENAMING(...) REFUSING(noName, __VA_ARGS__)

RENAMING(int, rename, -1, (const char* from, const char* to), (from, to))
RENAMING(int, renameat2, -1, (int fromFolder, const char* from, int toFolder, const char* to, unsigned int flags),
         (fromFolder, from, toFolder, to, flags))
RENAMING(int, link, -1, (const char* from, const char* to), (from, to))
RENAMING(int, linkat, -1, (int fromFolder, const char* from, int toFolder, const char* to, int flags),
         (fromFolder, from, toFolder, to, flags))

// ---- reads

static int noData(void* caller) {
  if ((!forever && belongsToSpared(caller)) || !fails(READ)) return 0;
  errno = EIO;
  return 1;
}

#define NO_DATA() noData(CALLER)
#define READING(...) REFUSING(NO_DATA, __VA_ARGS__)

READING(ssize_t, read, -1, (int file, void* bytes, size_t count), (file, bytes, count))
READING(ssize_t, readv, -1, (int file, const struct iovec* parts, int count), (file, parts, count))
READING(ssize_t, pread, -1, (int file, void* bytes, size_t count, off_t at), (file, bytes, count, at))
READING(ssize_t, pread64, -1, (int file, void* bytes, size_t count, off64_t at), (file, bytes, count, at))
READING(size_t, fread, 0, (void* bytes, size_t size, size_t count, FILE* file), (bytes, size, count, file))

// ---- data on the disk

static int notSynced(void) {
  if (!fails(SYNC)) return 0;
  errno = EIO;
  return 1;
}

#define SYNCING(...) REFUSING(notSynced, __VA_ARGS__)

SYNCING(int, fsync, -1, (int file), (file))
SYNCING(int, fdatasync, -1, (int file), (file))

// ---- OpenCL

static cl_int deviceError(void) {
  if (!fails(DEVICE)) return CL_SUCCESS;
  return forever ? CL_INVALID_COMMAND_QUEUE : CL_OUT_OF_RESOURCES;
}

// Defines a function that returns an error of OpenCL.
#define ASKING_DEVICE(name, parameters, arguments)            \
  CL_API_ENTRY cl_int CL_API_CALL name parameters {           \
    static cl_int(*real) parameters;                          \
    if (real == NULL) real = (cl_int(*) parameters)next(#name); \
    const cl_int error = deviceError();                       \
    return error != CL_SUCCESS ? error : real arguments;      \
  }

ASKING_DEVICE(clEnqueueNDRangeKernel,
              (cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset, const size_t* items,
               const size_t* group, cl_uint waits, const cl_event* waitList, cl_event* event),
              (queue, kernel, dimensions, offset, items, group, waits, waitList, event))
ASKING_DEVICE(clEnqueueReadBuffer,
              (cl_command_queue queue, cl_mem buffer, cl_bool blocks, size_t offset, size_t bytes, void* data, cl_uint waits,
               const cl_event* waitList, cl_event* event),
              (queue, buffer, blocks, offset, bytes, data, waits, waitList, event))
ASKING_DEVICE(clEnqueueWriteBuffer,
              (cl_command_queue queue, cl_mem buffer, cl_bool blocks, size_t offset, size_t bytes, const void* data,
               cl_uint waits, const cl_event* waitList, cl_event* event),
              (queue, buffer, blocks, offset, bytes, data, waits, waitList, event))
ASKING_DEVICE(clEnqueueFillBuffer,
              (cl_command_queue queue, cl_mem buffer, const void* pattern, size_t patternBytes, size_t offset, size_t bytes,
               cl_uint waits, const cl_event* waitList, cl_event* event),
              (queue, buffer, pattern, patternBytes, offset, bytes, waits, waitList, event))
ASKING_DEVICE(clEnqueueCopyBuffer,
              (cl_command_queue queue, cl_mem from, cl_mem to, size_t fromOffset, size_t toOffset, size_t bytes, cl_uint waits,
               const cl_event* waitList, cl_event* event),
              (queue, from, to, fromOffset, toOffset, bytes, waits, waitList, event))
ASKING_DEVICE(clFinish, (cl_command_queue queue), (queue))
ASKING_DEVICE(clSetKernelArg, (cl_kernel kernel, cl_uint index, size_t bytes, const void* value),
              (kernel, index, bytes, value))

// Defines a function that makes something, or returns nothing and sets an error of OpenCL.
#define ASKING_DEVICE_FOR(type, name, parameters, arguments)      \
  CL_API_ENTRY type CL_API_CALL name parameters {                 \
    static type(*real) parameters;                                \
    if (real == NULL) real = (type(*) parameters)next(#name);     \
    const cl_int refused = deviceError();                         \
    if (refused == CL_SUCCESS) return real arguments;             \
    if (error != NULL) *error = refused;                          \
    return NULL;                                                  \
  }

ASKING_DEVICE_FOR(cl_mem, clCreateBuffer,
                  (cl_context context, cl_mem_flags flags, size_t bytes, void* host, cl_int* error),
                  (context, flags, bytes, host, error))
ASKING_DEVICE_FOR(cl_kernel, clCreateKernel, (cl_program program, const char* kernel, cl_int* error), (program, kernel, error))
ASKING_DEVICE_FOR(cl_command_queue, clCreateCommandQueue,
                  (cl_context context, cl_device_id device, cl_command_queue_properties properties, cl_int* error),
                  (context, device, properties, error))
ASKING_DEVICE_FOR(void*, clEnqueueMapBuffer,
                  (cl_command_queue queue, cl_mem buffer, cl_bool blocks, cl_map_flags flags, size_t offset, size_t bytes,
                   cl_uint waits, const cl_event* waitList, cl_event* event, cl_int* error),
                  (queue, buffer, blocks, flags, offset, bytes, waits, waitList, event, error))

// ---- threads

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* argument) {
  static int (*real)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  if (real == NULL)
    real = (int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*))next("pthread_create");
  if (!fails(THREAD)) return real(thread, attributes, work, argument);
  errno = EAGAIN;  // As clone() sets it.
  return EAGAIN;
}
