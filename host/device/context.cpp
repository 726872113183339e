#include "device/context.h"

#include <utility>

#include "device/opencl_context.h"

namespace prelight {

DeviceContext::DeviceContext(std::unique_ptr<OpenClContext> opencl) : opencl_(std::move(opencl)) {}
DeviceContext::~DeviceContext() = default;

const DeviceInfo& DeviceContext::info() const { return opencl_->info(); }

void DeviceContext::build(const std::string& file, const BuildOptions& options) {
  opencl_->program(file, options);
}

void DeviceContext::addFile(const std::string& file, const std::string& text) {
  opencl_->addFile(file, text);
}

double DeviceContext::buildSeconds() const { return opencl_->buildSeconds(); }

DeviceUse DeviceContext::use() const { return opencl_->use(); }

void DeviceContext::finish() { opencl_->finish(); }

}  // namespace prelight
