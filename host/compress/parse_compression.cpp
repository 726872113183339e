#include <fmt/format.h>

#include <charconv>
#include <vector>

#include "compress/compressed_parts.h"
#include "prelight/error.h"
#include "prelight/save_compressed.h"
#include "prelight/transfer.h"

namespace prelight {

namespace {

constexpr const char* expected =
    "expected auto, half, band8, rgbe, pca:K, vq:N or cpca:N:K (N clusters, K components), pca and cpca with "
    ":float, :half or :byte for the weights, and any of them after auto:";

std::vector<std::string_view> partsOf(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t colon = text.find(':'); colon != std::string_view::npos; colon = text.find(':')) {
    parts.push_back(text.substr(0, colon));
    text.remove_prefix(colon + 1);
  }
  parts.push_back(text);
  return parts;
}

class CompressionParser {
 public:
  explicit CompressionParser(std::string_view text) : text_(text), parts_(partsOf(text)) {}

  CompressionRequest read() {
    CompressionRequest request;
    const std::string_view method = parts_[at_++];
    if (method == "half") {
      request.method = CompressionMethod::Half;
    } else if (method == "band8") {
      request.method = CompressionMethod::Band8;
    } else if (method == "rgbe") {
      request.method = CompressionMethod::Rgbe;
    } else if (method == "pca") {
      request.method = CompressionMethod::Pca;
      request.components = number("components", 4096);
      readWeights(request);
    } else if (method == "vq") {
      request.method = CompressionMethod::Vq;
      request.clusters = number("clusters", 65536);
    } else if (method == "cpca") {
      request.method = CompressionMethod::Cpca;
      request.clusters = number("clusters", 65536);
      request.components = number("components", 4096);
      readWeights(request);
    } else {
      fail();
    }
    if (at_ != parts_.size()) fail();
    return request;
  }

 private:
  [[noreturn]] void fail(const std::string& what = {}) const {
    throw UsageError("CompressionRequest::method", fmt::format("got '{}'{}, {}", text_, what, expected),
                     "for instance cpca:64:8");
  }

  int number(const char* what, int most) {
    if (at_ == parts_.size()) fail(fmt::format(" without the number of {}", what));
    const std::string_view part = parts_[at_++];
    int value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size() || value < 1 || value > most)
      fail(fmt::format(" whose number of {} is not one from 1 to {}", what, most));
    return value;
  }

  void readWeights(CompressionRequest& request) {
    if (at_ == parts_.size()) return;
    const std::string_view part = parts_[at_++];
    if (part == "float") {
      request.weights = WeightStorage::Float;
    } else if (part == "half") {
      request.weights = WeightStorage::Half;
    } else if (part == "byte") {
      request.weights = WeightStorage::Byte;
    } else {
      fail();
    }
  }

  std::string_view text_;
  std::vector<std::string_view> parts_;
  std::size_t at_ = 0;
};

const char* suffix(WeightStorage weights) {
  switch (weights) {
    case WeightStorage::Float:
      return ":float";
    case WeightStorage::Half:
      return "";
    case WeightStorage::Byte:
      return ":byte";
  }
  return "";
}

}  // namespace

CompressionRequest parseCompression(std::string_view text) { return CompressionParser(text).read(); }

FileCompression parseFileCompression(std::string_view text) {
  constexpr std::string_view everything = "auto";
  if (text == everything) return {.everything = true};
  const bool wantsAll = text.starts_with("auto:");
  if (wantsAll) text.remove_prefix(everything.size() + 1);
  return {.transfer = parseCompression(text), .everything = wantsAll};
}

std::string compressionName(const CompressionRequest& request) {
  const std::string_view method = compressionMethodNames[static_cast<std::size_t>(request.method)];
  switch (request.method) {
    case CompressionMethod::Half:
    case CompressionMethod::Band8:
    case CompressionMethod::Rgbe:
      return std::string(method);
    case CompressionMethod::Pca:
      return fmt::format("{}:{}{}", method, request.components, suffix(request.weights));
    case CompressionMethod::Vq:
      return fmt::format("{}:{}", method, request.clusters);
    case CompressionMethod::Cpca:
      return fmt::format("{}:{}:{}{}", method, request.clusters, request.components, suffix(request.weights));
  }
  return {};
}

}  // namespace prelight
