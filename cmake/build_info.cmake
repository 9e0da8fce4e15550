# Writes OUT from IN: fills in the commit of SOURCE and whether tracked files differ from it.
cmake_minimum_required(VERSION 3.25)

set(commit unknown)
set(dirty false)
find_program(git git)
if(git)
  # Another user may own the checkout (containers): this one is named as safe for these commands alone.
  set(git "${git}" -c "safe.directory=${SOURCE}" -C "${SOURCE}")
  execute_process(COMMAND ${git} rev-parse --show-toplevel HEAD
    OUTPUT_VARIABLE answer ERROR_QUIET RESULT_VARIABLE result OUTPUT_STRIP_TRAILING_WHITESPACE)
  file(REAL_PATH "${SOURCE}" top)
  if(result EQUAL 0 AND answer MATCHES "^(.*)\n([0-9a-f]+)$" AND CMAKE_MATCH_1 STREQUAL top)
    set(commit "${CMAKE_MATCH_2}")
    execute_process(COMMAND ${git} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes ERROR_QUIET)
    if(changes)
      set(dirty true)
    endif()
  endif()
endif()

file(READ "${IN}" text)
string(REPLACE "%COMMIT%" "${commit}" text "${text}")
string(REPLACE "%DIRTY%" "${dirty}" text "${text}")
file(CONFIGURE OUTPUT "${OUT}" CONTENT "${text}" @ONLY)  # leaves an unchanged file alone
