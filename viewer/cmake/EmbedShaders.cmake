# Writes OUTPUT: a C++ table of the FILES' texts by file name.
set(body "#include \"viewer/shader_sources.h\"\n\nnamespace prelight::viewer {\n\nconst std::map<std::string, std::string>& shaderSources() {\n  static const std::map<std::string, std::string> sources = {\n")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND body "      {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
string(APPEND body "  };\n  return sources;\n}\n\n}  // namespace prelight::viewer\n")
file(WRITE ${OUTPUT} "${body}")
