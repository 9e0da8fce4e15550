# pytest, a file a test. Each is skipped, with the reason, where what it needs is missing.
execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import pytest, hypothesis" RESULT_VARIABLE lacks_pytest OUTPUT_QUIET ERROR_QUIET)
execute_process(COMMAND "${Python3_EXECUTABLE}" -m mypy --version RESULT_VARIABLE lacks_mypy OUTPUT_QUIET ERROR_QUIET)

# What asks the C++ library the same questions, row by row.
file(GLOB sources CONFIGURE_DEPENDS "${tests}/row_by_row/*.cpp")
add_executable(thinwall_row_by_row ${sources})
target_link_libraries(thinwall_row_by_row PRIVATE thinwall::compiled thinwall::certified thinwall_options)
target_compile_options(thinwall_row_by_row PRIVATE $<$<CONFIG:Release>:-O1>)
target_compile_definitions(thinwall_row_by_row PRIVATE THINWALL_HOT=inline)

# thinwall_python_test(NAME LACKS WHAT COMMAND...): skipped where LACKS is not 0.
function(thinwall_python_test name lacks what)
  if(lacks)
    add_test(NAME python.${name} COMMAND "${CMAKE_COMMAND}" -E echo "skipped: ${what} is not installed")
  else()
    add_test(NAME python.${name} COMMAND "${Python3_EXECUTABLE}" -B -m ${ARGN} WORKING_DIRECTORY "${tests}")
  endif()
  set(environment "PYTHONPATH=${PROJECT_BINARY_DIR}/python;THINWALL_SOURCE=${PROJECT_SOURCE_DIR}"
    "THINWALL_ROW_BY_ROW=$<TARGET_FILE:thinwall_row_by_row>;MPLBACKEND=Agg")
  set_tests_properties(python.${name} PROPERTIES TIMEOUT 300 SKIP_REGULAR_EXPRESSION "^skipped: "
    ENVIRONMENT "${environment}")
endfunction()

file(GLOB files CONFIGURE_DEPENDS "${tests}/test_*.py")
foreach(file IN LISTS files)
  cmake_path(GET file STEM name)
  string(REPLACE "test_" "" name "${name}")
  thinwall_python_test(${name} "${lacks_pytest}" "pytest or hypothesis (Debian: python3-pytest python3-hypothesis)"
    pytest -q -p no:cacheprovider "${file}")
endforeach()
thinwall_python_test(types "${lacks_mypy}" "mypy (Debian: mypy)"
  mypy --strict --cache-dir "${PROJECT_BINARY_DIR}/python/mypy" "${PROJECT_BINARY_DIR}/python/thinwall" "${tests}/typed_use.py")
