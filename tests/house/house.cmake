# The house's own tests: headers alone, include direction, the installed package, the documents' snippets, the citation.
set(house "${CMAKE_CURRENT_LIST_DIR}")

# Every header alone: one file a header, which includes it twice, after the largest headers of others, which take most of the time to
# read, and nothing else. A broken one stops the build.
# `all.cpp` includes them all: one file for clang-tidy to read, never built.
set(all "${CMAKE_CURRENT_BINARY_DIR}/headers/all.cpp")
set(all_includes "")
foreach(folder IN ITEMS discrete capsule swept experiments)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/${folder}" "${PROJECT_SOURCE_DIR}/${folder}/*.hpp")
  set(sources "")
  foreach(header IN LISTS headers)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/headers/${folder}/${header}.cpp")
    set(include "#include <thinwall/${folder}/${header}>\n")
    file(CONFIGURE OUTPUT "${source}" CONTENT "${include}${include}" @ONLY)
    list(APPEND sources "${source}")
    string(APPEND all_includes "${include}")
  endforeach()

  add_library(headers_alone_${folder} OBJECT ${sources})
  target_compile_options(headers_alone_${folder} PRIVATE -O0 -g0 ${thinwall_seen_only})
  target_link_libraries(headers_alone_${folder} PRIVATE thinwall::${folder} thinwall_options)
  target_precompile_headers(headers_alone_${folder} PRIVATE <Eigen/Core>)
  if(folder STREQUAL "discrete")
    target_link_libraries(headers_alone_${folder} PRIVATE Boost::headers)  # the broad phase's R-tree
  elseif(folder STREQUAL "swept")
    target_link_libraries(headers_alone_${folder} PRIVATE thinwall::certified)  # its headers lie there
    target_precompile_headers(headers_alone_${folder} PRIVATE <boost/multiprecision/cpp_int.hpp>)
  elseif(folder STREQUAL "experiments")
    target_precompile_headers(headers_alone_${folder} PRIVATE <fmt/format.h> <nlohmann/json.hpp>)
  endif()
  if(NOT THINWALL_HEADERS_ALONE)
    set_target_properties(headers_alone_${folder} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
endforeach()
file(CONFIGURE OUTPUT "${all}" CONTENT "${all_includes}" @ONLY)
add_library(headers_all OBJECT EXCLUDE_FROM_ALL "${all}")
target_link_libraries(headers_all PRIVATE thinwall::experiments thinwall::certified thinwall_options)

# Dependencies point one way, and the check itself is checked on trees that break each rule.
add_test(NAME house/include_direction
  COMMAND "${CMAKE_COMMAND}" "-DROOT=${PROJECT_SOURCE_DIR}" -P "${house}/include_direction.cmake")
add_test(NAME house/include_direction_sees_each_fault
  COMMAND "${CMAKE_COMMAND}" "-DWORK=${work}/include_direction" -P "${house}/include_direction_test.cmake")

add_test(NAME house/presets COMMAND "${CMAKE_COMMAND}" "-DROOT=${PROJECT_SOURCE_DIR}" -P "${house}/presets.cmake")

# A pair that is not served is a compile error that names it.
add_test(NAME house/unserved_pair_is_named
  COMMAND "${CMAKE_COMMAND}" "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DSOURCE=${CMAKE_CURRENT_SOURCE_DIR}/swept/unserved_pair.cpp"
          "-DINCLUDES=${PROJECT_BINARY_DIR}/include;$<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>;$<TARGET_PROPERTY:Boost::headers,INTERFACE_INCLUDE_DIRECTORIES>"
          -P "${house}/unserved_pair.cmake")

if(thinwall_slow_build)  # what follows does not depend on sanitizers
  return()
endif()

# Installed, then found and used by a project that knows nothing of this tree.
set(with_batch OFF)
if(TARGET thinwall::batch AND CMAKE_BUILD_TYPE STREQUAL "Release")
  set(with_batch ON)
endif()
add_test(NAME house/installed_package
  COMMAND "${CMAKE_COMMAND}" "-DBATCH=${with_batch}" "-DBUILD=${PROJECT_BINARY_DIR}" "-DCONSUMER=${CMAKE_CURRENT_SOURCE_DIR}/consumer"
          "-DWORK=${work}/consumer" "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DGENERATOR=${CMAKE_GENERATOR}"
          "-DVERSION=${PROJECT_VERSION}" -P "${house}/installed_package.cmake")
set_tests_properties(house/installed_package PROPERTIES TIMEOUT 300)

# CITATION.cff says what CMake says.
add_test(NAME house/citation
  COMMAND "${CMAKE_COMMAND}" "-DFILE=${PROJECT_SOURCE_DIR}/CITATION.cff" "-DVERSION=${PROJECT_VERSION}"
          "-DDATE=${THINWALL_RELEASE_DATE}" -P "${house}/citation.cmake")

# Every C++ block of the documents compiles, and a whole program runs.
include("${house}/snippets.cmake")
file(GLOB documents CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CONTRIBUTING.md" "${PROJECT_SOURCE_DIR}/docs/*.md")
foreach(document IN LISTS documents)
  thinwall_snippets("${document}")
endforeach()

if(TARGET thinwall AND NOT WIN32)
  include("${house}/contributed.cmake")
endif()
