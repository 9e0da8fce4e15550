# pytest, a file a test. Each is skipped, with the reason, where what it needs is missing.
execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import pytest, hypothesis" RESULT_VARIABLE lacks_pytest OUTPUT_QUIET ERROR_QUIET)
execute_process(COMMAND "${Python3_EXECUTABLE}" -m mypy --version RESULT_VARIABLE lacks_mypy OUTPUT_QUIET ERROR_QUIET)

set(environment "PYTHONPATH=${PROJECT_BINARY_DIR}/python" "THINWALL_SOURCE=${PROJECT_SOURCE_DIR}" "MPLBACKEND=Agg")

# An interpreter that is not built with a sanitizer must load its runtime first, and before it what the runtime looks for.
string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
set(sanitized OFF)
if("${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${config}}" MATCHES "-fsanitize=[a-z,]*address")
  set(sanitized ON)
  execute_process(COMMAND "${CMAKE_CXX_COMPILER}" "-print-file-name=libclang_rt.asan-${CMAKE_SYSTEM_PROCESSOR}.so"
    OUTPUT_VARIABLE runtime OUTPUT_STRIP_TRAILING_WHITESPACE)
  execute_process(COMMAND "${CMAKE_CXX_COMPILER}" -print-file-name=libstdc++.so.6
    OUTPUT_VARIABLE standard OUTPUT_STRIP_TRAILING_WHITESPACE)
  # What Python itself never frees is not ours; and it is a few times slower, which a test of the import would find.
  list(APPEND environment "LD_PRELOAD=${runtime} ${standard}" "ASAN_OPTIONS=detect_leaks=0" "THINWALL_SANITIZED=1")
endif()

# thinwall_python_test(NAME LACKS WHAT COMMAND...): skipped where LACKS is not 0.
function(thinwall_python_test name lacks what)
  if(lacks)
    add_test(NAME python.${name} COMMAND "${CMAKE_COMMAND}" -E echo "skipped: ${what} is not installed")
  else()
    add_test(NAME python.${name} COMMAND "${Python3_EXECUTABLE}" -B -m ${ARGN} WORKING_DIRECTORY "${tests}")
  endif()
  set_tests_properties(python.${name} PROPERTIES TIMEOUT 600 SKIP_REGULAR_EXPRESSION "^skipped: " ENVIRONMENT "${environment}")
endfunction()

# What asks the C++ library the same questions, row by row. Answers do not depend on sanitizers: not built for them.
if(NOT sanitized)
  add_executable(thinwall_row_by_row "${tests}/row_by_row.cpp")
  target_link_libraries(thinwall_row_by_row PRIVATE thinwall::compiled thinwall::certified thinwall_options)
  target_compile_options(thinwall_row_by_row PRIVATE $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(thinwall_row_by_row PRIVATE THINWALL_HOT=inline)
  list(APPEND environment "THINWALL_ROW_BY_ROW=$<TARGET_FILE:thinwall_row_by_row>")
endif()

file(GLOB files CONFIGURE_DEPENDS "${tests}/test_*.py")
if(sanitized)  # what reads and writes memory
  list(FILTER files INCLUDE REGEX "/test_(queries|broad_phase)[.]py$")
endif()
foreach(file IN LISTS files)
  cmake_path(GET file STEM name)
  string(REPLACE "test_" "" name "${name}")
  thinwall_python_test(${name} "${lacks_pytest}" "pytest or hypothesis (Debian: python3-pytest python3-hypothesis)"
    pytest -q -p no:cacheprovider "${file}")
endforeach()
if(NOT sanitized)
  thinwall_python_test(types "${lacks_mypy}" "mypy (Debian: mypy)" mypy --strict --cache-dir "${PROJECT_BINARY_DIR}/python/mypy"
    "${PROJECT_BINARY_DIR}/python/thinwall" "${tests}/typed_use.py")
endif()
