# Compiles SOURCE, a scene whose list has a pair that is not served, and expects an error that says so and names both
# shapes. COMPILER, INCLUDES: how.
cmake_minimum_required(VERSION 3.25)

list(TRANSFORM INCLUDES PREPEND "-I")

function(compile result said)
  execute_process(COMMAND "${COMPILER}" -std=c++20 -fsyntax-only ${INCLUDES} ${ARGN} "${SOURCE}"
    RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  set(${result} ${status} PARENT_SCOPE)
  set(${said} "${text}" PARENT_SCOPE)
endfunction()

foreach(way IN ITEMS ONE_BY_ONE GROUPED)
  compile(status said -D${way})
  if(status EQUAL 0)
    message(SEND_ERROR "${way}: compiles, though a box and a triangle are no pair")
  elseif(NOT said MATCHES "this pair of shapes is not served"
      OR NOT said MATCHES "AskedOf<thinwall::Obb<double>, *thinwall::Triangle<double> *>")
    message(SEND_ERROR "${way}: the error does not name the pair:\n${said}")
  endif()
endforeach()

compile(status said -DTURNING)
if(status EQUAL 0 OR NOT said MATCHES "an Aabb that turns is an Obb")
  message(SEND_ERROR "TURNING: the error does not say what a box that turns is:\n${said}")
endif()
