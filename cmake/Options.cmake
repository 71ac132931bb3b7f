# What every target of ours is compiled with, and nothing imported is.
add_library(sc_options INTERFACE)
target_compile_options(sc_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Werror
                                            -ffp-contract=off)
# One include root: every include names its room, so the arrows between rooms can be read.
target_include_directories(sc_options INTERFACE ${PROJECT_SOURCE_DIR})
# Packets of two doubles in vectors of three cost a store that the next load must wait for: without
# them the analytic engine takes the same instructions and two thirds of the time. One definition
# for all targets, because it changes how Eigen lays out and allocates its types.
target_compile_definitions(sc_options INTERFACE TWINCRAFT_VERSION="${PROJECT_VERSION}"
                                                EIGEN_DONT_VECTORIZE)

# The rooms go into a shared library, too, from which nothing gets out but its C interface. A unique
# symbol would be shared by two versions of that library in one process.
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
# Programs and rooms with one and the same option, because they share precompiled headers.
target_compile_options(sc_options INTERFACE -fPIC $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)

option(TWINCRAFT_SANITIZE "Sanitizers, and the harnesses of tests/fuzz; needs Clang" OFF)
if(TWINCRAFT_SANITIZE)
  # Clang knows other warnings than the compiler we hold ourselves to.
  target_compile_options(sc_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined
                                              -fno-sanitize-recover=all -fno-omit-frame-pointer
                                              -w)
  target_link_options(sc_options INTERFACE -fsanitize=address,undefined)
endif()

# A build that was done before is not done again. ccache takes precompiled headers only when told that
# neither __TIME__ nor macros of the command line hide in them, which is so; the options that let it
# look through them are harmless without it.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()
target_compile_options(sc_options INTERFACE
  # From 128 MB on GCC collects its garbage, which takes a tenth of the time of a build. Without
  # it sources take up to 100 MB more, at most 830 MB.
  "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=524288>"
  # What g++ 12 says of bounds inside std::string is false and depends on the length of literals,
  # paths among them; the sanitizer build watches bounds.
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread>"
  $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
  "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")

# A room: a static library of ours. sc_room(NAME sources... ) then target_link_libraries.
function(sc_room name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PUBLIC sc_options)
  target_precompile_headers(${name} REUSE_FROM sc_precompiled)
endfunction()

# A program of ours: sc_program(NAME sources... ) then target_link_libraries.
function(sc_program name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE sc_options)
  target_precompile_headers(${name} REUSE_FROM sc_precompiled)
endfunction()

# sc_cold(TARGET [SOURCE...]): what takes longer to compile than it will ever run. Nothing that a run
# repeats, per step or per sample, is in it. -O1 leaves every result as it is.
function(sc_cold target)
  set(sources ${ARGN})
  if(NOT sources)
    get_target_property(sources ${target} SOURCES)
  endif()
  set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
endfunction()
