#include "cli/options/encoding_option.h"

#include <fmt/format.h>

#include <string>

#include "techniques/encoded_light/encoding_names.h"

namespace prelight::cli {

void addEncodingOption(CLI::App& app, const Encoding*& encoding) {
  app.add_option_function<std::string>(
         "--encoding",
         [&encoding](const std::string& name) { encoding = &requireEncoding("--encoding", name); },
         fmt::format("lightmap and radiosity shading: draw with the light that is stored in this encoding, "
                     "to which normal maps apply: {}",
                     encodingNames()))
      ->type_name("NAME");
}

}  // namespace prelight::cli
