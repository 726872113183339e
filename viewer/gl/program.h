#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "viewer/gl/object.h"

namespace prelight::viewer::gl {

/// A linked vertex and fragment shader of viewer/shaders.
class Program {
 public:
  /// Compiles two embedded files. `#include "FILE"` lines (whole line) are resolved among them.
  /// `replaced`: texts that stand for files of their names.
  /// Throws Error with the file and line that the compiler complains about.
  Program(const std::string& vertexFile, const std::string& fragmentFile,
          const std::map<std::string, std::string>& replaced = {});

  /// A vertex shader alone, whose outputs are captured one after the other by transform feedback.
  Program(const std::string& vertexFile, const std::vector<const char*>& captured,
          const std::map<std::string, std::string>& replaced = {});

  void use() const { glUseProgram(program_.name()); }

  /// Setters act on the program in use; a name that the compiler has removed is ignored.
  void set(const char* name, int value) const { glUniform1i(location(name), value); }
  void set(const char* name, float value) const { glUniform1f(location(name), value); }
  void set(const char* name, const glm::vec2& value) const { glUniform2fv(location(name), 1, &value.x); }
  void set(const char* name, const glm::ivec4& value) const { glUniform4iv(location(name), 1, &value.x); }
  void set(const char* name, const glm::vec3& value) const { glUniform3fv(location(name), 1, &value.x); }
  void set(const char* name, const glm::vec4& value) const { glUniform4fv(location(name), 1, &value.x); }
  void set(const char* name, const glm::mat4& value) const {
    glUniformMatrix4fv(location(name), 1, GL_FALSE, &value[0].x);
  }

  /// The first elements of an array.
  void set(const char* name, std::span<const float> values) const {
    glUniform1fv(location(name), static_cast<GLsizei>(values.size()), values.data());
  }
  void set(const char* name, std::span<const glm::vec3> values) const {
    glUniform3fv(location(name), static_cast<GLsizei>(values.size()), &values.front().x);
  }
  void set(const char* name, std::span<const glm::vec4> values) const {
    glUniform4fv(location(name), static_cast<GLsizei>(values.size()), &values.front().x);
  }

  /// Ties a uniform block to a binding point.
  void bindBlock(const char* name, GLuint binding) const;

 private:
  GLint location(const char* name) const;

  void link(const std::string& what) const;

  Object<ProgramTraits> program_;
  mutable std::map<std::string, GLint, std::less<>> locations_;  ///< of the names that were set
};

}  // namespace prelight::viewer::gl
