#pragma once

#include "viewer/gl/object.h"

namespace prelight::viewer::gl {

struct QueryTraits {
  static GLuint create() {
    GLuint name = 0;
    glGenQueries(1, &name);
    return name;
  }
  static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};

/// The time that OpenGL itself takes for what is asked of it between begin() and end(). One at a time.
class TimerQuery {
 public:
  /// The driver counts time at all.
  static bool works() {
    GLint bits = 0;
    glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
    return bits > 0;
  }

  void begin() const { glBeginQuery(GL_TIME_ELAPSED, query_.name()); }
  void end() const { glEndQuery(GL_TIME_ELAPSED); }

  /// Waits until all of it is done.
  double seconds() const {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.name(), GL_QUERY_RESULT, &nanoseconds);
    return 1e-9 * static_cast<double>(nanoseconds);
  }

 private:
  Object<QueryTraits> query_;
};

}  // namespace prelight::viewer::gl
