#pragma once

#include <cstddef>

namespace prelight::viewer::gl {

/// Tells those who watch the current context (UploadCounter, tools that trace OpenGL) that as many bytes of a
/// buffer or a texture went to it: a debug message, whose number is the bytes. Contexts below OpenGL 4.3 have
/// none, and nobody is told.
void noteUpload(std::size_t bytes);

/// Counts the bytes that noteUpload() tells the current context of while it exists. One at a time.
class UploadCounter {
 public:
  UploadCounter();
  ~UploadCounter();
  UploadCounter(const UploadCounter&) = delete;
  UploadCounter& operator=(const UploadCounter&) = delete;

  static bool works();  ///< the context has debug messages

  std::size_t bytes() const { return bytes_; }

 private:
  std::size_t bytes_ = 0;
};

}  // namespace prelight::viewer::gl
