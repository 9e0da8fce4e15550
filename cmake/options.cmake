# What our own programs and tests are compiled with. Users of the headers keep their own options.

find_program(THINWALL_CCACHE ccache DOC "Compiler cache, used if found")
if(THINWALL_CCACHE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${THINWALL_CCACHE}")
endif()

set(thinwall_compile_options
  -ffp-contract=off  # the same bits from every compiler: no fused multiply-add behind our back
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Woverloaded-virtual -Wcast-align -Wformat=2 -Wimplicit-fallthrough -Wundef)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarms on std::string, GCC bug 105329, and on a std::variant that holds one.
  list(APPEND thinwall_compile_options -Wno-restrict -Wno-maybe-uninitialized)
endif()
if(THINWALL_WERROR)
  list(APPEND thinwall_compile_options -Werror)
endif()
if(THINWALL_NATIVE)
  list(APPEND thinwall_compile_options -march=native)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # it pays where there are 32 registers: docs/performance.md
    list(APPEND thinwall_compile_options -fschedule-insns -fsched-pressure --param=sched-pressure-algorithm=2)
  endif()
endif()

# The preset asan-ubsan, which takes ten times as long for everything. `thinwall_seen_only`: what it compiles to see that Clang takes it.
# No file of the program is left unoptimized there to save time: the linker would take the inline functions of all from it.
set(thinwall_slow_build OFF)
set(thinwall_seen_only "")
if(CMAKE_BUILD_TYPE STREQUAL "Debug" AND CMAKE_CXX_FLAGS_DEBUG MATCHES "THINWALL_SLOW_BUILD")
  set(thinwall_slow_build ON)
  set(thinwall_seen_only -O0 -g0 -fno-sanitize=all)
endif()

# Geometry is numbers: what watches addresses finds nothing in it and doubles the time it takes to compile. The batches, the fuzz
# target and the experiments are watched.
set(thinwall_without_memory -fno-sanitize=address)

add_library(thinwall_options INTERFACE)
target_compile_options(thinwall_options INTERFACE ${thinwall_compile_options})

# thinwall_headers(NAME LINKS TARGET...): the header-only target thinwall::NAME of the folder of that name.
function(thinwall_headers name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" LINKS)
  add_library(thinwall_${name} INTERFACE)
  add_library(thinwall::${name} ALIAS thinwall_${name})
  set_target_properties(thinwall_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(thinwall_${name} INTERFACE cxx_std_20)
  target_include_directories(thinwall_${name} INTERFACE
    "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_link_libraries(thinwall_${name} INTERFACE ${arg_LINKS})
endfunction()

# thinwall_unite(TARGET SOURCE... [TOGETHER A+B...]): compiles the sources of each folder as one file, together with FOLDER.cpp beside
# it, and those of folders A and B (SUB_FOLDER of one within another) as one. Nine tenths of the time of a small file go into what it
# includes. A source with options of its own stays alone.
function(thinwall_unite target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" TOGETHER)
  foreach(together IN LISTS arg_TOGETHER)
    string(REPLACE "+" ";" folders "${together}")
    foreach(folder IN LISTS folders)
      set(group_of_${folder} "${together}")
    endforeach()
  endforeach()
  foreach(source IN LISTS arg_UNPARSED_ARGUMENTS)
    cmake_path(ABSOLUTE_PATH source)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" OUTPUT_VARIABLE path)
    cmake_path(GET path PARENT_PATH folder)
    if(folder STREQUAL "")
      cmake_path(GET path STEM folder)
      if(NOT IS_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/${folder}")
        set(folder alone)
      endif()
    endif()
    string(REPLACE "/" "_" group "${folder}")
    if(DEFINED group_of_${group})
      string(REPLACE "+" "_" group "${group_of_${group}}")
    endif()
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP
    UNITY_BUILD_CODE_BEFORE_INCLUDE "// NOLINTNEXTLINE(bugprone-suspicious-include)")
endfunction()
