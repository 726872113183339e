#pragma once

#include <span>

#include "viewer/gl/object.h"
#include "viewer/gl/uploads.h"

namespace prelight::viewer::gl {

/// A buffer object that keeps what it was filled with last.
class Buffer : public Object<BufferTraits> {
 public:
  Buffer() = default;

  /// Fills a new buffer with data that does not change.
  template <typename T>
  Buffer(GLenum target, std::span<const T> data) {
    fill(target, data, GL_STATIC_DRAW);
  }

  /// Replaces the contents, whatever their size was.
  template <typename T>
  void fill(GLenum target, std::span<const T> data, GLenum usage) const {
    glBindBuffer(target, name());
    glBufferData(target, static_cast<GLsizeiptr>(data.size_bytes()), data.data(), usage);
    noteUpload(data.size_bytes());
  }

  /// Replaces bytes from `offset` on, which it has room for.
  template <typename T>
  void replace(GLenum target, std::size_t offset, std::span<const T> data) const {
    glBindBuffer(target, name());
    glBufferSubData(target, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size_bytes()),
                    data.data());
    noteUpload(data.size_bytes());
  }
};

}  // namespace prelight::viewer::gl
