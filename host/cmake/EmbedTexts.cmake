# Writes OUTPUT: a C++ table of the FILES' texts by path relative to ROOT, or to that of several ROOTs that they lie below: the
# function NAME that HEADER declares.
# CMake takes seconds for what loops over characters, so each text goes into one raw literal as it is.
set(longest 65000)  # characters that every compiler takes in one literal
set(body "#include \"${HEADER}\"\n\nnamespace prelight {\n\nconst std::map<std::string, std::string>& ${NAME}() {\n  static const std::map<std::string, std::string> sources = {\n")
foreach(file ${FILES})
  foreach(root ${ROOT})
    file(RELATIVE_PATH name ${root} ${file})
    if(NOT name MATCHES "^\\.\\./")
      break()
    endif()
  endforeach()
  file(READ ${file} text)
  string(FIND "${text}" ")text\"" end)
  string(LENGTH "${text}" length)
  if(length GREATER longest OR NOT end EQUAL -1)
    message(FATAL_ERROR "${file} does not fit into one raw literal: it has ${length} characters of ${longest}, or )text\" in it")
  endif()
  string(APPEND body "      {\"${name}\", R\"text(${text})text\"},\n")
endforeach()
string(APPEND body "  };\n  return sources;\n}\n\n}  // namespace prelight\n")
file(WRITE ${OUTPUT} "${body}")
