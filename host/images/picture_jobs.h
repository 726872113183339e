#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "images/picture_header.h"
#include "images/pixels.h"
#include "prelight/picture.h"
#include "sandbox/job_socket.h"

namespace prelight {

/// The library's request to a process that decodes pictures.
struct PictureRequest {
  PictureFormat format = PictureFormat::Unknown;
  std::string where;  ///< place that errors name
  std::vector<std::uint8_t> bytes;
};

void putRequest(JobSocket& socket, PictureFormat format, const std::string& where,
                std::span<const std::uint8_t> bytes);
PictureRequest getPictureRequest(JobSocket& socket);

// Results. Receiving throws JobSocketFailure for sizes that no picture has.
void putResult(JobSocket& socket, const Pixels& pixels);
void putResult(JobSocket& socket, const PictureLayers& layers);
void putResult(JobSocket& socket, const Image& image);
void getResult(JobSocket& socket, Pixels& pixels);
void getResult(JobSocket& socket, PictureLayers& layers);
void getResult(JobSocket& socket, Image& image);

template <typename Result>
void putResult(JobSocket& socket, const std::optional<Result>& result) {
  socket.put(result.has_value());
  if (result) putResult(socket, *result);
}
template <typename Result>
void getResult(JobSocket& socket, std::optional<Result>& result) {
  if (socket.get<std::uint8_t>() != 0) getResult(socket, result.emplace());
}

}  // namespace prelight
