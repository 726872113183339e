#include "images/picture_jobs.h"

namespace prelight {

namespace {

constexpr std::uint64_t mostChannels = std::uint64_t{1} << 16;

void putSize(JobSocket& socket, int width, int height) {
  socket.put(width);
  socket.put(height);
}

/// Returns the number of texels.
std::uint64_t getSize(JobSocket& socket, int& width, int& height) {
  width = socket.get<int>();
  height = socket.get<int>();
  if (width < 0 || height < 0) throw JobSocketFailure("a negative size");
  const std::uint64_t texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (texels > mostPictureTexels) throw JobSocketFailure("more texels than a picture has");
  return texels;
}

/// Receives exactly `count` values.
template <typename T>
std::vector<T> getAll(JobSocket& socket, std::uint64_t count) {
  std::vector<T> values = socket.getArray<T>(count);
  if (values.size() != count) throw JobSocketFailure("fewer values than the picture has");
  return values;
}

}  // namespace

void putRequest(JobSocket& socket, PictureFormat format, const std::string& where,
                std::span<const std::uint8_t> bytes) {
  socket.put(format);
  socket.putText(where);
  socket.putArray(bytes);
}

PictureRequest getPictureRequest(JobSocket& socket) {
  PictureRequest request;
  request.format = socket.get<PictureFormat>();
  request.where = socket.getText();
  request.bytes = socket.getArray<std::uint8_t>(mostEncodedBytes);
  return request;
}

void putResult(JobSocket& socket, const Pixels& pixels) {
  putSize(socket, pixels.width, pixels.height);
  socket.putArray(std::span(pixels.rgb));
}

void getResult(JobSocket& socket, Pixels& pixels) {
  const std::uint64_t texels = getSize(socket, pixels.width, pixels.height);
  pixels.rgb = getAll<glm::vec3>(socket, texels);
}

void putResult(JobSocket& socket, const PictureLayers& layers) {
  putSize(socket, layers.width, layers.height);
  socket.put(std::uint64_t{layers.channels.size()});
  for (const PictureChannel& channel : layers.channels) {
    socket.putText(channel.name);
    socket.putArray(std::span(channel.values));
  }
}

void getResult(JobSocket& socket, PictureLayers& layers) {
  const std::uint64_t texels = getSize(socket, layers.width, layers.height);
  const auto channels = socket.get<std::uint64_t>();
  if (channels > mostChannels) throw JobSocketFailure("more channels than a picture has");
  layers.channels.clear();
  for (std::uint64_t c = 0; c < channels; ++c) {
    std::string name = socket.getText();
    layers.channels.push_back({std::move(name), getAll<float>(socket, texels)});
  }
}

void putResult(JobSocket& socket, const Image& image) {
  putSize(socket, image.width, image.height);
  socket.putArray(std::span(image.rgba));
}

void getResult(JobSocket& socket, Image& image) {
  const std::uint64_t texels = getSize(socket, image.width, image.height);
  image.rgba = getAll<std::uint8_t>(socket, 4 * texels);
}

}  // namespace prelight
