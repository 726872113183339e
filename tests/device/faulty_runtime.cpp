// Preloaded library that makes kernel compilers, decoders and threads of a program under test fail.
//   FAULT_COMPILER=crash|kill|hang: effect of compiling a source; binaries are accepted as usual.
//   FAULT_DECODER=crash|kill|hang: effect of reading the header of a PNG.
//   FAULT_THREAD=N: the Nth thread and all later ones cannot be created.
#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

namespace {

using Notify = void(CL_CALLBACK*)(cl_program, void*);

bool hasSource(cl_program program) {
  size_t bytes = 0;
  return clGetProgramInfo(program, CL_PROGRAM_SOURCE, 0, nullptr, &bytes) == CL_SUCCESS && bytes > 1;
}

/// Fails in the way that the word names; returns if the word means nothing.
void fail(std::string_view word) {
  if (word == "crash") {
    std::fputs("a warning before\nLLVM ERROR: made up by a test\n", stderr);
    std::abort();
  }
  if (word == "kill") std::raise(SIGKILL);
  while (word == "hang") pause();
}

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id* devices, const char* options,
                      Notify notify, void* data) {
  const char* fault = std::getenv("FAULT_COMPILER");
  if (fault != nullptr && hasSource(program)) fail(fault);
  return next<decltype(clBuildProgram)>("clBuildProgram")(program, count, devices, options, notify, data);
}

void png_read_info(void* png, void* info) {
  const char* fault = std::getenv("FAULT_DECODER");
  if (fault != nullptr) fail(fault);
  next<void(void*, void*)>("png_read_info")(png, info);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) {
  static std::atomic<int> asked = 0;
  const char* first = std::getenv("FAULT_THREAD");
  if (first != nullptr && ++asked >= std::atoi(first)) return EAGAIN;
  return next<decltype(pthread_create)>("pthread_create")(thread, attributes, start, argument);
}
}
