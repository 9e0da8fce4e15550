# The experiment of CONTRIBUTING.md, taken from its text: the blocks that begin with ```LANGUAGE PATH become files, and with the
# library a program that has this experiment alone.
set(page "${PROJECT_SOURCE_DIR}/CONTRIBUTING.md")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${page}")
set(contributed "${CMAKE_CURRENT_BINARY_DIR}/contributed")
file(READ "${page}" text)
foreach(path IN ITEMS experiments/chord/chord.cpp experiments/chord.toml tests/results/small/chord.toml docs/chord.md)
  string(REGEX MATCH "\n```[a-z]+ ${path}\n" opening "${text}")
  string(FIND "${text}" "${opening}" start)
  string(LENGTH "${opening}" length)
  if(NOT opening)
    message(FATAL_ERROR "CONTRIBUTING.md has no block for ${path}")
  endif()
  math(EXPR start "${start} + ${length}")
  string(SUBSTRING "${text}" ${start} -1 rest)
  string(FIND "${rest}" "\n```\n" end)
  string(SUBSTRING "${rest}" 0 ${end} block)
  thinwall_write("${contributed}/${path}" "${block}\n")
endforeach()
thinwall_write("${contributed}/main.cpp" "#include <iostream>

#include <thinwall/experiments/program/program.hpp>

namespace thinwall {
Experiment chord_experiment();
}

int main(int argc, char** argv) {
  const std::vector<thinwall::Experiment> experiments = {thinwall::chord_experiment()};
  return thinwall::run_program({argv, argv + argc}, experiments, std::cout, std::cerr);
}
")
set(embedded "${contributed}/embedded.cpp")
add_custom_command(OUTPUT "${embedded}"
  COMMAND "${CMAKE_COMMAND}" "-DTOMLS=${contributed}/experiments/chord.toml" "-DPAGES=${contributed}/docs/chord.md"
          "-DOUT=${embedded}" -P "${PROJECT_SOURCE_DIR}/cmake/embed.cmake"
  DEPENDS "${contributed}/experiments/chord.toml" "${contributed}/docs/chord.md" "${PROJECT_SOURCE_DIR}/cmake/embed.cmake"
  VERBATIM)
add_executable(thinwall_contributed "${contributed}/main.cpp" "${contributed}/experiments/chord/chord.cpp" "${embedded}")
target_link_libraries(thinwall_contributed PRIVATE thinwall::experiments thinwall_options)
target_compile_options(thinwall_contributed PRIVATE $<$<CONFIG:Release>:-O1>)
add_test(NAME house/contributed
  COMMAND "${CMAKE_CURRENT_LIST_DIR}/contributed.sh" "$<TARGET_FILE:thinwall_contributed>" "${work}/contributed" "${contributed}" "${PROJECT_SOURCE_DIR}")
