#include "io/plan_json.h"

namespace prelight {

nlohmann::ordered_json toJson(std::span<const PlannedPass> passes) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const PlannedPass& pass : passes)
    json.push_back({{"name", pass.name}, {"runs", pass.runs}, {"reason", pass.reason}});
  return json;
}

nlohmann::ordered_json toJson(const Plan& plan) {
  return {{"passes", toJson(std::span<const PlannedPass>(plan.passes))},
          {"memory",
           {{"hostBytes", plan.hostBytes},
            {"deviceBytes", plan.deviceBytes},
            {"transportBytes", plan.transportBytes},
            {"texelBytes", plan.texelBytes},
            {"recordBytes", plan.recordBytes},
            {"parks", plan.parks}}}};
}

Plan planFromJson(const JsonCursor& json) {
  Plan plan;
  json.forEachObject("passes", [&](const JsonCursor& pass, std::size_t) {
    plan.passes.push_back(
        {pass.stringOr("name", ""), pass.boolOr("runs", false), pass.stringOr("reason", "")});
  });
  if (const auto memory = json.find("memory")) {
    plan.hostBytes = memory->unsignedOr("hostBytes", 0);
    plan.deviceBytes = memory->unsignedOr("deviceBytes", 0);
    plan.transportBytes = memory->unsignedOr("transportBytes", 0);
    plan.texelBytes = memory->unsignedOr("texelBytes", 0);
    plan.recordBytes = memory->unsignedOr("recordBytes", 0);
    plan.parks = memory->boolOr("parks", false);
  }
  return plan;
}

}  // namespace prelight
