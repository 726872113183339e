#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/report.h"
#include "cli/session.h"
#include "device/pocl.h"
#include "gpu/self_test.h"

namespace prelight::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the devices that --device selects. Device::open() throws the explanation if there is none.
std::vector<DeviceInfo> chosenDevices(Session& session) {
  std::vector<DeviceInfo> devices = listDevices();
  if (devices.empty() || session.options().device) {
    const DeviceInfo chosen = Device::open(session.deviceOptions()).info();
    std::erase_if(devices, [&](const DeviceInfo& device) { return device.index != chosen.index; });
  }
  const bool pocl = std::any_of(devices.begin(), devices.end(), [](const DeviceInfo& d) { return d.isPocl; });
  if (const auto warning = poclCacheWarning(); warning && pocl)
    session.deviceOptions().progress->warn(*warning);
  return devices;
}

void printDevice(const Console& console, const DeviceInfo& device) {
  console.line(fmt::format("{}", device.index), device.name);
  console.line("", fmt::format("{}, {}", device.platform, device.openclVersion));
  console.line("", fmt::format("driver {}, {} compute units, {} memory, {} at most in one buffer",
                               device.driverVersion, device.computeUnits,
                               shortBytes(static_cast<double>(device.globalMemory)),
                               shortBytes(static_cast<double>(device.maxAllocation))));
}

std::vector<SelfTestResult> testDevice(Session& session, const DeviceInfo& info) {
  try {
    DeviceOptions options = session.deviceOptions();
    options.selector = std::to_string(info.index);
    return selfTest(Device::open(options));
  } catch (const Error& error) {
    return {{"open", false, error.what()}};
  }
}

/// Tests a device, prints one line per check and returns the number of failed checks.
std::size_t testAndPrint(Session& session, const DeviceInfo& info, Json& json) {
  const Console& console = session.console();
  const std::vector<SelfTestResult> results = testDevice(session, info);
  Json checks = Json::array();
  for (const SelfTestResult& result : results) {
    console.line("", fmt::format("{:<6}{}{}", result.passed ? "pass" : "FAIL", result.name,
                                 result.detail.empty() ? "" : ": " + result.detail));
    checks.push_back({{"name", result.name}, {"passed", result.passed}, {"detail", result.detail}});
  }
  const auto failed = static_cast<std::size_t>(std::count_if(
      results.begin(), results.end(), [](const SelfTestResult& result) { return !result.passed; }));
  const bool usable = failed == 0 && !results.empty();
  console.line("", usable ? "passed: this device can be used" : "FAILED: do not trust this device");
  json["checks"] = checks;
  json["passed"] = usable;
  return usable ? 0 : std::max<std::size_t>(failed, 1);
}

void runDevices(bool test, Context& context) {
  Session session(context);
  Json list = Json::array();
  std::size_t failed = 0;
  for (const DeviceInfo& device : chosenDevices(session)) {
    session.progress().check();
    Json json = toJson(device);
    printDevice(session.console(), device);
    if (test) failed += testAndPrint(session, device, json);
    list.push_back(std::move(json));
  }
  session.console().json(reportOf("devices", {{"devices", list}}));
  if (failed > 0)
    throw Error(ExitCode::RuntimeFailure, "devices --test", fmt::format("{} checks failed", failed),
                "update the OpenCL driver, or choose another device with --device");
}

}  // namespace

void addDevicesCommand(CLI::App& program, Context& context) {
  const auto test = std::make_shared<bool>(false);
  CLI::App* app = program.add_subcommand("devices", "List OpenCL devices, and test them");
  app->add_flag("--test", *test, "run the self-test of each device; succeeds only if every check does");
  app->footer(
      "Examples:\n"
      "  prelight devices\n"
      "  prelight devices --test --device pocl");
  app->callback([test, &context] { runDevices(*test, context); });
}

}  // namespace prelight::cli
