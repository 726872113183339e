// Preloaded library that records which kernels a program launches, and from which files, by wrapping OpenCL's functions.
// PRELIGHT_KERNEL_TRACE names the file to which lines "kernel file file ..." are appended: one line per kernel of each program
// object that is launched.
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 65536
#define NAME_BYTES 128

// Objects by handle. A handle may be reused after its release, so that the latest entry counts.
struct Program {
  cl_program handle;
  char* files;
};
struct Kernel {
  cl_kernel handle;
  char name[NAME_BYTES];
  char* files;
  int launched;
};

static struct Program programs[MOST];
static struct Kernel kernels[MOST];
static int program_count, kernel_count;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

// The files named by lines `#line 1 "file"`, separated by blanks.
static char* files_of(const char* source) {
  char* files = calloc(strlen(source) + 2, 1);
  for (const char* at = source; (at = strstr(at, "#line 1 \"")) != NULL;) {
    at += strlen("#line 1 \"");
    const char* end = strchr(at, '"');
    if (end == NULL) break;
    strcat(files, " ");
    strncat(files, at, (size_t)(end - at));
  }
  return files;
}

cl_program clCreateProgramWithSource(cl_context context, cl_uint count, const char** strings, const size_t* lengths,
                                     cl_int* error) {
  cl_program (*next)(cl_context, cl_uint, const char**, const size_t*, cl_int*) =
      dlsym(RTLD_NEXT, "clCreateProgramWithSource");
  const cl_program program = next(context, count, strings, lengths, error);
  if (program == NULL || count == 0) return program;
  pthread_mutex_lock(&lock);
  if (program_count < MOST) programs[program_count++] = (struct Program){program, files_of(strings[0])};
  pthread_mutex_unlock(&lock);
  return program;
}

cl_kernel clCreateKernel(cl_program program, const char* name, cl_int* error) {
  cl_kernel (*next)(cl_program, const char*, cl_int*) = dlsym(RTLD_NEXT, "clCreateKernel");
  const cl_kernel kernel = next(program, name, error);
  if (kernel == NULL) return kernel;
  pthread_mutex_lock(&lock);
  if (kernel_count < MOST) {
    struct Kernel* entry = &kernels[kernel_count++];
    *entry = (struct Kernel){.handle = kernel, .files = ""};
    strncpy(entry->name, name, NAME_BYTES - 1);
    for (int i = program_count; i-- > 0;)
      if (programs[i].handle == program) {
        entry->files = programs[i].files;
        break;
      }
  }
  pthread_mutex_unlock(&lock);
  return kernel;
}

static void note(const struct Kernel* kernel) {
  const char* path = getenv("PRELIGHT_KERNEL_TRACE");
  FILE* out = path == NULL ? NULL : fopen(path, "a");
  if (out == NULL) return;
  fprintf(out, "%s%s\n", kernel->name, kernel->files);
  fclose(out);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
                              const size_t* global, const size_t* local, cl_uint waits, const cl_event* wait,
                              cl_event* event) {
  cl_int (*next)(cl_command_queue, cl_kernel, cl_uint, const size_t*, const size_t*, const size_t*, cl_uint,
                 const cl_event*, cl_event*) = dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel");
  pthread_mutex_lock(&lock);
  for (int i = kernel_count; i-- > 0;)
    if (kernels[i].handle == kernel) {
      if (!kernels[i].launched) note(&kernels[i]);
      kernels[i].launched = 1;
      break;
    }
  pthread_mutex_unlock(&lock);
  return next(queue, kernel, dimensions, offset, global, local, waits, wait, event);
}
