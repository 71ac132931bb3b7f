# Spacecraft specs in a CMake project.
#
#   twincraft_compile(TARGET SPEC FILE [EMIT WORD...] [OUTPUT_DIRECTORY FOLDER] [SET PATH=VALUE...])
#
# A target in ALL that writes what `sccompile FILE --emit WORD,...` does. FILE is seen from the
# source folder, FOLDER (default: `.`) from the binary folder. It runs again when the spec or a file
# that it extends changes. The target's property TWINCRAFT_OUTPUTS lists the files.
#
#   twincraft_add_test(NAME NAME SPEC FILE [SET PATH=VALUE...])
#
# A test that passes where `scsim FILE` exits with 0: its verdict is `agree` or `not_judged`.
cmake_policy(PUSH)
cmake_policy(VERSION 3.20...3.25)

# What the keyword arguments of `caller` must be. Sets arg_SPEC to a path and `settings` to flags.
macro(_twincraft_read_spec caller program)
  if(DEFINED arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${caller}: unexpected argument `${arg_UNPARSED_ARGUMENTS}`")
  endif()
  if(DEFINED arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "${caller}: `${arg_KEYWORDS_MISSING_VALUES}` has no value")
  endif()
  if(NOT DEFINED arg_SPEC)
    message(FATAL_ERROR "${caller}: SPEC is missing; write for example `SPEC vehicle.yaml`")
  endif()
  if(NOT TARGET twincraft::${program})
    message(FATAL_ERROR "${caller} runs `${program}`, which is not installed beside the package in "
                        "${twincraft_DIR}; install Twincraft's component `programs` there")
  endif()
  get_filename_component(arg_SPEC "${arg_SPEC}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  if(NOT EXISTS "${arg_SPEC}")
    message(FATAL_ERROR "${caller}: there is no spec `${arg_SPEC}`")
  endif()
  set(settings)
  foreach(setting IN LISTS arg_SET)
    list(APPEND settings --set "${setting}")
  endforeach()
endmacro()

# The lines that sccompile prints, as a list.
function(_twincraft_ask result)
  get_target_property(sccompile twincraft::sccompile IMPORTED_LOCATION)
  execute_process(COMMAND ${sccompile} ${ARGN} RESULT_VARIABLE code
                  OUTPUT_VARIABLE lines ERROR_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT code EQUAL 0)
    string(REPLACE "\n" "\n  " said "\n${said}")  # indented, CMake leaves lines as they are
    message(FATAL_ERROR "twincraft_compile: sccompile exits with ${code}${said}")
  endif()
  string(REPLACE "\n" ";" lines "${lines}")
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()

function(twincraft_compile target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SPEC;OUTPUT_DIRECTORY" "EMIT;SET")
  _twincraft_read_spec(twincraft_compile sccompile)
  if(NOT DEFINED arg_EMIT)
    set(arg_EMIT mjcf bsm)
  endif()
  if(NOT DEFINED arg_OUTPUT_DIRECTORY)
    set(arg_OUTPUT_DIRECTORY .)
  endif()
  list(JOIN arg_EMIT "," emit)
  get_filename_component(folder "${arg_OUTPUT_DIRECTORY}" ABSOLUTE
                         BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
  set(arguments "${arg_SPEC}" -o "${folder}" --emit "${emit}" ${settings})

  # The files are called after the vehicle, so what reads the spec is asked, again when it changes.
  _twincraft_ask(inputs ${arguments} --list inputs)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${inputs})
  _twincraft_ask(outputs ${arguments} --list outputs)

  set(depfile "${CMAKE_CURRENT_BINARY_DIR}/${target}.twincraft.d")
  add_custom_command(
    OUTPUT ${outputs}
    COMMAND twincraft::sccompile ${arguments} --depfile "${depfile}"
    DEPENDS "${arg_SPEC}" twincraft::sccompile
    DEPFILE "${depfile}"
    COMMENT "Compiling spacecraft ${arg_SPEC}"
    VERBATIM)
  add_custom_target(${target} ALL DEPENDS ${outputs})
  set_target_properties(${target} PROPERTIES TWINCRAFT_OUTPUTS "${outputs}")
endfunction()

function(twincraft_add_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;SPEC" "SET")
  if(NOT DEFINED arg_NAME)
    message(FATAL_ERROR "twincraft_add_test: NAME is missing; write for example `NAME agrees`")
  endif()
  _twincraft_read_spec(twincraft_add_test scsim)
  add_test(NAME "${arg_NAME}"
           COMMAND twincraft::scsim "${arg_SPEC}" ${settings} --no-timing --progress never)
endfunction()

cmake_policy(POP)
