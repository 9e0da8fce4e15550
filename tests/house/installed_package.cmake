# Installs BUILD into WORK, then configures, builds and runs CONSUMER against what was installed, and nothing else.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${WORK}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

set(configure "${CMAKE_COMMAND}" -G "${GENERATOR}" -S "${CONSUMER}" "-DCMAKE_CXX_COMPILER=${COMPILER}"
  "-DCMAKE_PREFIX_PATH=${WORK}/prefix" "-DEXPECTED_VERSION=${VERSION}")
execute_process(COMMAND ${configure} -B "${WORK}/build" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK}/build" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK}/build/consumer" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK}/build/prover" COMMAND_ERROR_IS_FATAL ANY)
if(BATCH)  # a library, not headers: built as the consumer is
  execute_process(COMMAND ${configure} -B "${WORK}/build" "-DCOMPONENTS=swept;certified;batch" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK}/build" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${WORK}/build/batcher" COMMAND_ERROR_IS_FATAL ANY)
endif()

# A component that does not exist, and a version that is not there, are refused by name.
function(expect_refusal option message)
  file(REMOVE_RECURSE "${WORK}/refused")
  execute_process(COMMAND ${configure} -B "${WORK}/refused" "${option}" RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  if(result EQUAL 0 OR NOT said MATCHES "${message}")
    message(FATAL_ERROR "${option} was not refused with \"${message}\":\n${said}")
  endif()
endfunction()
expect_refusal(-DCOMPONENTS=teleport "thinwall has no component 'teleport'; it has discrete, capsule, swept, certified")
expect_refusal(-DREQUESTED_VERSION=99.0 "requested version \"99.0\"")
