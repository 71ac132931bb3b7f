# The headers that most of our sources include, parsed once. sc_precompiled NAME LINK...: an object
# library of nothing but them, for target_precompile_headers(... REUSE_FROM NAME). Every source
# still includes what it uses, which tools/lint sees to: it parses without them.
#
# Left out is what costs more in the sources without it than it saves in those with it:
# nlohmann/json.hpp leaves 0.3 s of templates to instantiate behind in each.
set(sc_precompiled_headers
  <algorithm> <array> <charconv> <cmath> <cstddef> <cstdint> <filesystem> <functional> <limits>
  <map> <memory> <numbers> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view>
  <utility> <variant> <vector> <Eigen/Geometry> <fmt/format.h>)

function(sc_precompiled name)
  cmake_parse_arguments(arg "" "" "HEADERS;LINK" ${ARGN})
  set(source ${CMAKE_BINARY_DIR}/precompiled.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// A library needs a source.\n")
  add_library(${name} OBJECT ${source})
  target_link_libraries(${name} PRIVATE sc_options Eigen3::Eigen fmt::fmt ${arg_LINK})
  target_precompile_headers(${name} PRIVATE ${sc_precompiled_headers} ${arg_HEADERS})
endfunction()

# Headers parsed with a macro are no good to a source without it, so all targets have fmt's.
target_compile_definitions(sc_options INTERFACE
  $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)

sc_precompiled(sc_precompiled)
