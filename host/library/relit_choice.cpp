#include "library/relit_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "prelight/error.h"
#include "techniques/registry/registry.h"

namespace prelight {

namespace {

/// A transfer of a bake, and its form on a device.
struct HeldTransfer {
  const Technique* technique = nullptr;
  std::string form;
};

/// Returns what a bake holds, the preferred first.
std::vector<HeldTransfer> heldBy(const Bake& bake) {
  std::vector<HeldTransfer> held;
  for (const Technique& technique : techniques()) {
    if (technique.relighting == nullptr) continue;
    std::string form = technique.relighting->form(bake);
    if (!form.empty()) held.push_back({&technique, std::move(form)});
  }
  std::ranges::stable_sort(held, std::greater<>(),
                           [](const HeldTransfer& one) { return one.technique->relighting->preference; });
  return held;
}

std::string namesOf(const std::vector<HeldTransfer>& held) {
  std::vector<std::string_view> names;
  for (const HeldTransfer& one : held) names.push_back(one.technique->name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void checkName(const std::string& wanted) {
  const std::vector<std::string> names = relitTechniques();
  if (std::ranges::find(names, wanted) == names.end())
    throw UsageError("RelighterOptions::technique",
                     fmt::format("got '{}', expected one of {}", wanted, fmt::join(names, ", ")));
}

}  // namespace

std::vector<std::string> relitTechniques() {
  std::vector<std::string> names;
  for (const Technique& technique : techniques())
    if (technique.relighting != nullptr) names.emplace_back(technique.name);
  return names;
}

RelitChoice chooseTransfer(const Bake& bake, const std::string& wanted) {
  if (!wanted.empty()) checkName(wanted);
  std::vector<HeldTransfer> held = heldBy(bake);
  const auto chosen = std::ranges::find_if(
      held, [&](const HeldTransfer& one) { return wanted.empty() || one.technique->name == wanted; });
  if (chosen == held.end()) {
    const std::string has = held.empty() ? "nothing that can be relit" : "only " + namesOf(held);
    throw InputError("bake", wanted.empty() ? "it has " + has : fmt::format("it has no {}, {}", wanted, has),
                     fmt::format("bake one of {}", fmt::join(relitTechniques(), ", ")));
  }
  const HeldTransfer transfer = *chosen;
  held.erase(chosen);
  std::string reason = fmt::format("{}: {}; {}", transfer.technique->name, transfer.form,
                                   wanted.empty() ? "preferred" : "chosen by RelighterOptions::technique");
  if (!held.empty()) reason += "; the bake also has " + namesOf(held);
  return {std::string(transfer.technique->name), transfer.technique->relighting, reason};
}

std::vector<std::unique_ptr<RelitPart>> makeAddedParts(const RelitSource& source) {
  std::vector<std::unique_ptr<RelitPart>> parts;
  for (const Technique& technique : techniques()) {
    const Relighting* relighting = technique.relighting;
    if (relighting != nullptr && relighting->makeAdded != nullptr && !relighting->form(source.bake).empty())
      parts.push_back(relighting->makeAdded(source));
  }
  return parts;
}

}  // namespace prelight
