# A small result folder of every experiment, and what readers do with one: check it, open its report in a browser, cite its
# tables and figures in LaTeX, load its data. The folders are made once, for all of these tests.
set(results "${CMAKE_CURRENT_LIST_DIR}")
set(folders "${work}/results")
find_program(THINWALL_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)  # the system's, which has its packages
find_program(THINWALL_PYTHON python3)
find_program(THINWALL_CHROMIUM NAMES chromium chromium-browser google-chrome)
find_program(THINWALL_LATEX NAMES pdflatex lualatex)

add_test(NAME results/folders
  COMMAND "${CMAKE_COMMAND}" "-DPROGRAM=$<TARGET_FILE:thinwall>" "-DWORK=${folders}" "-DSMALL=${results}/small"
          "-DSCENES=${PROJECT_SOURCE_DIR}/experiments/scenes" -P "${results}/folders.cmake")
set_tests_properties(results/folders PROPERTIES FIXTURES_SETUP results TIMEOUT 600)

# thinwall_results_test(NAME PROGRAM_THAT_MAY_BE_ABSENT COMMAND...): skipped, with the reason, where the program is absent.
function(thinwall_results_test name program what)
  if(program)
    add_test(NAME results/${name} COMMAND ${ARGN})
  else()
    add_test(NAME results/${name} COMMAND "${CMAKE_COMMAND}" -E echo "skipped: ${what} is not installed")
  endif()
  set_tests_properties(results/${name} PROPERTIES FIXTURES_REQUIRED results TIMEOUT 300 SKIP_REGULAR_EXPRESSION "skipped: ")
endfunction()

thinwall_results_test(latex "${THINWALL_LATEX}" "LaTeX"
  "${CMAKE_COMMAND}" "-DLATEX=${THINWALL_LATEX}" "-DFOLDERS=${folders}" "-DWORK=${work}/latex" -P "${results}/latex.cmake")
thinwall_results_test(datapackage "${THINWALL_PYTHON}" "python3"
  "${THINWALL_PYTHON}" "${results}/datapackage.py" "${results}/datapackage.schema.json" "${folders}")
set(browser "${THINWALL_CHROMIUM}")
if(NOT THINWALL_PYTHON)
  set(browser "")
endif()
thinwall_results_test(browser "${browser}" "Chromium, or python3,"
  "${THINWALL_PYTHON}" "${results}/browser.py" "${THINWALL_CHROMIUM}" "${folders}")
