// Reads an element of a buffer of four on the first device, whether the buffer has it or not: `stray_reader INDEX`.
#define CL_TARGET_OPENCL_VERSION 120
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS
#include <CL/cl.h>
#include <stdlib.h>

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const cl_int index = atoi(arguments[1]);
  const char* source = "kernel void take(global const float* from, global float* to, int i) { *to = from[i]; }";
  cl_platform_id platform;
  cl_device_id device;
  if (clGetPlatformIDs(1, &platform, NULL) != CL_SUCCESS) return 3;
  if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, NULL) != CL_SUCCESS) return 3;
  const cl_context context = clCreateContext(NULL, 1, &device, NULL, NULL, NULL);
  const cl_command_queue queue = clCreateCommandQueue(context, device, 0, NULL);
  const cl_program program = clCreateProgramWithSource(context, 1, &source, NULL, NULL);
  if (clBuildProgram(program, 1, &device, "", NULL, NULL) != CL_SUCCESS) return 3;
  const cl_kernel kernel = clCreateKernel(program, "take", NULL);
  const cl_mem from = clCreateBuffer(context, CL_MEM_READ_WRITE, 4 * sizeof(cl_float), NULL, NULL);
  const cl_mem to = clCreateBuffer(context, CL_MEM_READ_WRITE, sizeof(cl_float), NULL, NULL);
  clSetKernelArg(kernel, 0, sizeof from, &from);
  clSetKernelArg(kernel, 1, sizeof to, &to);
  clSetKernelArg(kernel, 2, sizeof index, &index);
  const size_t items = 1;
  if (clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &items, &items, 0, NULL, NULL) != CL_SUCCESS) return 3;
  return clFinish(queue) == CL_SUCCESS ? 0 : 3;
}
