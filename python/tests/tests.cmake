# pytest, a file a test. Each is skipped, with the reason, where what it needs is missing.
execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import pytest, hypothesis" RESULT_VARIABLE lacks_pytest OUTPUT_QUIET ERROR_QUIET)
file(GLOB files CONFIGURE_DEPENDS "${tests}/test_*.py")
foreach(file IN LISTS files)
  cmake_path(GET file STEM name)
  string(REPLACE "test_" "" name "${name}")
  if(lacks_pytest)
    add_test(NAME python.${name}
      COMMAND "${CMAKE_COMMAND}" -E echo "skipped: pytest or hypothesis is not installed (Debian: python3-pytest python3-hypothesis)")
  else()
    add_test(NAME python.${name} COMMAND "${Python3_EXECUTABLE}" -B -m pytest -q -p no:cacheprovider "${file}"
      WORKING_DIRECTORY "${PROJECT_BINARY_DIR}/python")
  endif()
  set_tests_properties(python.${name} PROPERTIES TIMEOUT 300 SKIP_REGULAR_EXPRESSION "^skipped: "
    ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python;THINWALL_SOURCE=${PROJECT_SOURCE_DIR}")
endforeach()
