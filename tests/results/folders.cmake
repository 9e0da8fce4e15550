# Runs PROGRAM on every configuration in SMALL, and on two scenes, into WORK, draws the figures for print, and checks each folder.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
execute_process(COMMAND gnuplot --version RESULT_VARIABLE gnuplot OUTPUT_QUIET ERROR_QUIET)
set(figures "")
if(gnuplot EQUAL 0)
  set(figures --figures pdf,tex)
endif()

# call(WORDS...): stops with what the program said if it does not exit with 0.
function(call)
  execute_process(COMMAND "${PROGRAM}" ${ARGN} WORKING_DIRECTORY "${SMALL}" OUTPUT_VARIABLE out ERROR_VARIABLE err RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " words)
    message(FATAL_ERROR "thinwall ${words}\nended with ${status}:\n${err}${out}")
  endif()
endfunction()

function(check name)
  if(figures)  # without gnuplot a folder lacks its figures, and the check says so
    call(report "${WORK}/${name}" --check)
  endif()
endfunction()

file(GLOB configurations "${SMALL}/*.toml")
foreach(configuration IN LISTS configurations)
  cmake_path(GET configuration STEM name)
  set(more "")
  if(name STREQUAL "speed")
    set(more --benchmarks ../benchmarks)  # programs that print what a benchmark might: a test looks at no times
  endif()
  call(run "${configuration}" --seed 1 --threads 2 --out "${WORK}/${name}" ${more} ${figures})
  check(${name})
endforeach()
call(run "${SCENES}/bullet_against_bullet.toml" --threads 2 --out "${WORK}/scene" ${figures})
check(scene)
call(compare "${SCENES}/bullet_against_bullet.toml" --threads 2 --out "${WORK}/compare" ${figures})
check(compare)

# Every experiment that the program knows has a small configuration.
execute_process(COMMAND "${PROGRAM}" list --json OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(JSON count LENGTH "${listed}")
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  string(JSON name GET "${listed}" ${i} name)
  if(NOT EXISTS "${WORK}/${name}/manifest.json")
    message(SEND_ERROR "tests/results/small/${name}.toml: missing; every experiment has one")
  endif()
endforeach()
