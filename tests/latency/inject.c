// Measures how long a window takes to answer: a library to preload, which drags the mouse in the window by GLFW's
// callbacks and takes the time from each such event to the end of the next swap of buffers. measure.py runs it.
// LATENCY_FILE: where lines "phase wall-ms processor-ms" go. LATENCY_PHASES: "name:seconds:interval-ms ..."; the window
// closes after the last.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

typedef struct GLFWwindow GLFWwindow;
typedef void (*ButtonCallback)(GLFWwindow*, int, int, int);
typedef void (*CursorCallback)(GLFWwindow*, double, double);

static ButtonCallback buttonCallback;
static CursorCallback cursorCallback;
static GLFWwindow* window;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static double pendingSince, pendingProcessor;  // of an event that was not delivered yet; 0: none
static double deliveredSince, deliveredProcessor;
static char phase[64];
static int over, started;
static double angle;
static FILE* results;

static double secondsOf(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void* original(const char* name) { return dlsym(RTLD_NEXT, name); }

static void post(void) {
  pthread_mutex_lock(&lock);
  if (pendingSince == 0.0 && deliveredSince == 0.0) {
    pendingSince = secondsOf(CLOCK_MONOTONIC);
    pendingProcessor = secondsOf(CLOCK_PROCESS_CPUTIME_ID);
  }
  pthread_mutex_unlock(&lock);
  ((void (*)(void))original("glfwPostEmptyEvent"))();
}

static void* runPhases(void* ignored) {
  (void)ignored;
  char* phases = strdup(getenv("LATENCY_PHASES"));
  char* next = NULL;
  unsigned seed = 1;
  for (char* one = strtok_r(phases, " ", &next); one != NULL; one = strtok_r(NULL, " ", &next)) {
    char name[64];
    double seconds = 0.0, interval = 0.0;
    if (sscanf(one, "%63[^:]:%lf:%lf", name, &seconds, &interval) != 3) continue;
    pthread_mutex_lock(&lock);
    strcpy(phase, name);
    pthread_mutex_unlock(&lock);
    const double end = secondsOf(CLOCK_MONOTONIC) + seconds;
    while (secondsOf(CLOCK_MONOTONIC) < end) {
      const double share = 0.5 + (double)rand_r(&seed) / RAND_MAX;  // so that events come at any time of a frame
      usleep((useconds_t)(1e3 * interval * share));
      post();
    }
  }
  over = 1;
  ((void (*)(void))original("glfwPostEmptyEvent"))();
  return NULL;
}

static void deliver(void) {
  if (over) ((void (*)(GLFWwindow*, int))original("glfwSetWindowShouldClose"))(window, 1);
  pthread_mutex_lock(&lock);
  const int any = pendingSince != 0.0;
  deliveredSince = pendingSince;
  deliveredProcessor = pendingProcessor;
  pendingSince = 0.0;
  pthread_mutex_unlock(&lock);
  if (!any) {
    deliveredSince = 0.0;
    return;
  }
  angle += 0.1;
  cursorCallback(window, 1000.0 + 60.0 * cos(angle), 560.0 + 20.0 * sin(angle));
  buttonCallback(window, 0, 1, 0);
  angle += 0.1;
  cursorCallback(window, 1000.0 + 60.0 * cos(angle), 560.0 + 20.0 * sin(angle));
  buttonCallback(window, 0, 0, 0);
}

ButtonCallback glfwSetMouseButtonCallback(GLFWwindow* of, ButtonCallback callback) {
  buttonCallback = callback;
  return ((ButtonCallback(*)(GLFWwindow*, ButtonCallback))original("glfwSetMouseButtonCallback"))(of, callback);
}

CursorCallback glfwSetCursorPosCallback(GLFWwindow* of, CursorCallback callback) {
  cursorCallback = callback;
  return ((CursorCallback(*)(GLFWwindow*, CursorCallback))original("glfwSetCursorPosCallback"))(of, callback);
}

void glfwPollEvents(void) {
  ((void (*)(void))original("glfwPollEvents"))();
  if (window != NULL) deliver();
}

void glfwWaitEventsTimeout(double timeout) {
  ((void (*)(double))original("glfwWaitEventsTimeout"))(timeout);
  if (window != NULL) deliver();
}

void glfwSwapBuffers(GLFWwindow* of) {
  ((void (*)(GLFWwindow*))original("glfwSwapBuffers"))(of);
  window = of;
  if (started < 10 && ++started == 10) {
    pthread_t thread;
    results = fopen(getenv("LATENCY_FILE"), "w");
    pthread_create(&thread, NULL, runPhases, NULL);
    pthread_detach(thread);
  }
  if (deliveredSince == 0.0) return;
  fprintf(results, "%s %.2f %.2f\n", phase, 1e3 * (secondsOf(CLOCK_MONOTONIC) - deliveredSince),
          1e3 * (secondsOf(CLOCK_PROCESS_CPUTIME_ID) - deliveredProcessor));
  fflush(results);
  deliveredSince = 0.0;
}
