#include "viewer/gl/program.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "prelight/error.h"
#include "viewer/gl/shader_log.h"
#include "viewer/gl/shader_sources.h"

namespace prelight::viewer::gl {
namespace {

struct ShaderTraits {
  static void destroy(GLuint name) { glDeleteShader(name); }
};
using Shader = Object<ShaderTraits>;

/// A shader's text with its includes in place. GLSL knows files by number only: `files` gives their names.
struct Expanded {
  std::string text;
  std::vector<std::string> files;
};

using Texts = std::map<std::string, std::string>;

void expand(const std::string& file, const Texts& replaced, Expanded& out) {
  auto found = replaced.find(file);
  if (found == replaced.end()) found = shaderSources().find(file);
  if (found == shaderSources().end()) throw Error(ExitCode::RuntimeFailure, "shader " + file, "no such file");
  const std::size_t number = out.files.size();
  out.files.push_back(file);
  std::istringstream lines(found->second);
  std::string line;
  if (number > 0) out.text += "#line 1 " + std::to_string(number) + "\n";
  for (int lineNumber = 1; std::getline(lines, line); ++lineNumber) {
    const std::string included = includedPath(line);
    if (included.empty()) {
      out.text += line + "\n";
      continue;
    }
    expand(included, replaced, out);
    out.text += "#line " + std::to_string(lineNumber + 1) + " " + std::to_string(number) + "\n";
  }
}

Shader compile(GLenum stage, const std::string& file, const Texts& replaced) {
  Expanded source;
  expand(file, replaced, source);
  Shader shader(glCreateShader(stage));
  const char* text = source.text.c_str();
  glShaderSource(shader.name(), 1, &text, nullptr);
  glCompileShader(shader.name());
  GLint compiled = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  GLint length = 0;
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(std::max(length, 1), '\0');
  glGetShaderInfoLog(shader.name(), length, nullptr, log.data());
  throw Error(ExitCode::RuntimeFailure, "shader " + file,
              "does not compile:" + nameShaderFiles(log.c_str(), source.files));
}

}  // namespace

Program::Program(const std::string& vertexFile, const std::string& fragmentFile, const Texts& replaced) {
  const Shader vertex = compile(GL_VERTEX_SHADER, vertexFile, replaced);
  const Shader fragment = compile(GL_FRAGMENT_SHADER, fragmentFile, replaced);
  glAttachShader(program_.name(), vertex.name());
  glAttachShader(program_.name(), fragment.name());
  link("shaders " + vertexFile + " and " + fragmentFile);
}

Program::Program(const std::string& vertexFile, const std::vector<const char*>& captured,
                 const Texts& replaced) {
  const Shader vertex = compile(GL_VERTEX_SHADER, vertexFile, replaced);
  glAttachShader(program_.name(), vertex.name());
  glTransformFeedbackVaryings(program_.name(), static_cast<GLsizei>(captured.size()), captured.data(),
                              GL_INTERLEAVED_ATTRIBS);
  link("shader " + vertexFile);
}

void Program::link(const std::string& what) const {
  glLinkProgram(program_.name());
  GLint linked = 0;
  glGetProgramiv(program_.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  std::string log(4096, '\0');
  glGetProgramInfoLog(program_.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw Error(ExitCode::RuntimeFailure, what, std::string("does not link:\n  ") + log.c_str());
}

GLint Program::location(const char* name) const {
  const auto known = locations_.find(std::string_view(name));
  if (known != locations_.end()) return known->second;
  return locations_.emplace(name, glGetUniformLocation(program_.name(), name)).first->second;
}

void Program::bindBlock(const char* name, GLuint binding) const {
  const GLuint index = glGetUniformBlockIndex(program_.name(), name);
  if (index != GL_INVALID_INDEX) glUniformBlockBinding(program_.name(), index, binding);
}

}  // namespace prelight::viewer::gl
