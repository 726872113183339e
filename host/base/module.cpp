#include "base/module.h"

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "prelight/error.h"

namespace prelight {

namespace {

/// Returns true when a loader's message says that memory is short; the loader gives no other indication.
bool isWantOfMemory(const std::string& reason) {
  for (const char* words :
       {"failed to map", "cannot map", "Cannot allocate memory", "cannot allocate memory"})
    if (reason.find(words) != std::string::npos) return true;
  return false;
}

/// Returns why the loader found nothing.
std::string loaderReason() {
  const char* found = dlerror();
  return found != nullptr ? found : "no such symbol";
}

/// Returns a handle of the program or library that contains this code, or nullptr.
std::shared_ptr<void> ownHandle() {
  Dl_info info{};
  void* map = nullptr;
  if (dladdr1(reinterpret_cast<void*>(&ownHandle), &info, &map, RTLD_DL_LINKMAP) == 0) return nullptr;
  const char* name = static_cast<link_map*>(map)->l_name;
  void* handle = dlopen(*name == '\0' ? nullptr : name, RTLD_LAZY | RTLD_NOLOAD);  // no name: the program
  return {handle, [](void* opened) {
            if (opened != nullptr) dlclose(opened);
          }};
}

/// Returns the folders in which the loader searches for modules of this code.
std::vector<std::filesystem::path> searchedFolders() {
  const std::shared_ptr<void> self = ownHandle();
  Dl_serinfo size{};
  if (!self || dlinfo(self.get(), RTLD_DI_SERINFOSIZE, &size) != 0) return {};
  // The list and its texts follow the structure.
  std::vector<std::max_align_t> room(size.dls_size / sizeof(std::max_align_t) + 1);
  auto* found = reinterpret_cast<Dl_serinfo*>(room.data());
  *found = size;
  if (dlinfo(self.get(), RTLD_DI_SERINFO, found) != 0) return {};
  const Dl_serpath* paths = found->dls_serpath;
  std::vector<std::filesystem::path> folders;
  for (unsigned int i = 0; i < found->dls_cnt; ++i) folders.emplace_back(paths[i].dls_name);
  return folders;
}

}  // namespace

void* findModule(const char* file, std::string& reason) {
  // The module stays loaded, so that the next call finds it at once.
  void* module = dlopen(file, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (module != nullptr) return module;
  reason = loaderReason();
  if (isWantOfMemory(reason))
    throw Error(ExitCode::OutOfMemory, file, "cannot be loaded: " + reason,
                "raise the limit of the address space with ulimit -v");
  return nullptr;
}

void* findFunction(void* module, const char* function) { return dlsym(module, function); }

std::filesystem::path findProgramBesideModules(const char* file) {
  for (const std::filesystem::path& folder : searchedFolders()) {
    std::filesystem::path program = folder / file;
    if (folder.is_absolute() && ::access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

std::string fileOfFunction(void* function) {
  Dl_info info{};
  return dladdr(function, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "";
}

void* moduleFunction(const char* file, const char* function) {
  std::string reason;
  void* module = findModule(file, reason);
  void* symbol = module != nullptr ? findFunction(module, function) : nullptr;
  if (symbol != nullptr) return symbol;
  if (module != nullptr) reason = loaderReason();
  throw Error(ExitCode::RuntimeFailure, file, "cannot be loaded: " + reason,
              "install it beside the other libraries of prelight");
}

}  // namespace prelight
