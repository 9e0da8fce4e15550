# Compiles SOURCE, which asks to certify a pair that cannot be, and expects an error that says so and names both shapes.
# COMPILER, INCLUDES: how.
cmake_minimum_required(VERSION 3.25)

list(TRANSFORM INCLUDES PREPEND "-I")
set(compile "${COMPILER}" -std=c++20 -fsyntax-only ${INCLUDES})

execute_process(COMMAND ${compile} "${SOURCE}" RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(status EQUAL 0)
  message(SEND_ERROR "compiles, though a box and a triangle cannot be certified")
elseif(NOT said MATCHES "this pair of shapes cannot be certified"
    OR NOT said MATCHES "CertifiedAskedOf<thinwall::Obb<double>, *thinwall::Triangle<double> *>")
  message(SEND_ERROR "the error does not name the pair:\n${said}")
endif()
