#include "viewer/gl/egl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <string>
#include <vector>

#include "prelight/error.h"
#include "viewer/gl/libraries.h"

namespace prelight::viewer::gl {
namespace {

/// Displays that need no display server, best first.
std::vector<EGLDisplay> candidates() {
  std::vector<EGLDisplay> displays;
  const auto add = [&](EGLenum platform, void* native) {
    const EGLDisplay display = eglGetPlatformDisplayEXT(platform, native, nullptr);
    if (display != EGL_NO_DISPLAY) displays.push_back(display);
  };
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) return displays;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    add(EGL_PLATFORM_SURFACELESS_MESA, nullptr);
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
      for (EGLint i = 0; i < count; ++i) add(EGL_PLATFORM_DEVICE_EXT, devices[i]);
    }
  }
  return displays;
}

EGLContext makeContext(EGLDisplay display) {
  if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return EGL_NO_CONTEXT;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) return EGL_NO_CONTEXT;
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return EGL_NO_CONTEXT;
  constexpr std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                4,
                                                EGL_CONTEXT_MINOR_VERSION,
                                                1,
                                                EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                EGL_NONE};
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
  if (context == EGL_NO_CONTEXT) {
    constexpr std::array<EGLint, 3> wanted = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, wanted.data(), &config, 1, &count) == EGL_TRUE && count > 0) {
      context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    }
  }
  if (context == EGL_NO_CONTEXT) return EGL_NO_CONTEXT;
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) return context;
  eglDestroyContext(display, context);
  return EGL_NO_CONTEXT;
}

}  // namespace

EglContext::EglContext() {
  requireEgl();
  for (const EGLDisplay display : candidates()) {
    const EGLContext context = makeContext(display);
    if (context == EGL_NO_CONTEXT) continue;
    display_ = display;
    context_ = context;
    return;
  }
  throw Error(ExitCode::NoDevice, "OpenGL", "EGL gives no OpenGL 4.1 context without a display",
              "install a driver with EGL, for example Mesa's: apt install libegl1 libgl1-mesa-dri");
}

std::string EglContext::rendererName() const {
  return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

double EglContext::version() const { return epoxy_gl_version() / 10.0; }

EglContext::~EglContext() {
  // The display stays initialised: others in the process get the same handle, and terminating it would take
  // theirs.
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

}  // namespace prelight::viewer::gl
