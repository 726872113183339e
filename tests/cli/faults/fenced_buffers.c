// Preloaded library that puts a page without access beside every buffer of OpenCL, so that a kernel on a CPU that reads or
// writes past a buffer ends the program with a signal. What a buffer holds before it is written is NaN.
//
//   PRELIGHT_FENCE: `start` or `end`, where a buffer meets its fence. Unset: no fences.
#define CL_TARGET_OPENCL_VERSION 120
#define _GNU_SOURCE
#include <CL/cl.h>
#include <dlfcn.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { PAGE = 4096 };

struct Region {
  char* memory;
  size_t bytes;
};

typedef cl_mem (*CreateBuffer)(cl_context, cl_mem_flags, size_t, void*, cl_int*);

// Returns memory for a buffer between two fences, at the one that is named.
static struct Region* fencedRegion(size_t bytes) {
  struct Region* region = malloc(sizeof *region);
  if (region == NULL) return NULL;
  region->bytes = (bytes + PAGE - 1) / PAGE * PAGE + 2 * PAGE;
  region->memory = mmap(NULL, region->bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (region->memory == MAP_FAILED ||
      mprotect(region->memory + PAGE, region->bytes - 2 * PAGE, PROT_READ | PROT_WRITE) != 0) {
    free(region);
    return NULL;
  }
  return region;
}

static void CL_CALLBACK releaseRegion(cl_mem buffer, void* owned) {
  (void)buffer;
  struct Region* region = owned;
  munmap(region->memory, region->bytes);
  free(region);
}

CL_API_ENTRY cl_mem CL_API_CALL clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void* host,
                                               cl_int* error) {
  static CreateBuffer real;
  if (real == NULL) real = (CreateBuffer)dlsym(RTLD_NEXT, "clCreateBuffer");
  const char* side = getenv("PRELIGHT_FENCE");
  struct Region* region = side != NULL ? fencedRegion(bytes) : NULL;
  if (region == NULL) return real(context, flags, bytes, host, error);
  char* place = strcmp(side, "start") == 0 ? region->memory + PAGE : region->memory + region->bytes - PAGE - bytes;
  if (host != NULL)
    memcpy(place, host, bytes);
  else
    memset(place, 0xff, bytes);
  const cl_mem_flags others = ~(cl_mem_flags)(CL_MEM_COPY_HOST_PTR | CL_MEM_ALLOC_HOST_PTR);
  const cl_mem buffer = real(context, (flags & others) | CL_MEM_USE_HOST_PTR, bytes, place, error);
  if (buffer == NULL || clSetMemObjectDestructorCallback(buffer, releaseRegion, region) != CL_SUCCESS)
    releaseRegion(buffer, region);
  return buffer;
}
