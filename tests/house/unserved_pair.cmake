# Compiles SOURCE in each way in which it asks about a pair that is not served, and expects an error that says so and names both
# shapes. COMPILER, INCLUDES: how.
cmake_minimum_required(VERSION 3.25)

list(TRANSFORM INCLUDES PREPEND "-I")

# expect_error(WAY PATTERN...)
function(expect_error way)
  execute_process(COMMAND "${COMPILER}" -std=c++20 -fsyntax-only ${INCLUDES} -D${way} "${SOURCE}"
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  foreach(pattern IN LISTS ARGN)
    if(status EQUAL 0 OR NOT said MATCHES "${pattern}")
      message(SEND_ERROR "${way}: is not refused with \"${pattern}\":\n${said}")
    endif()
  endforeach()
endfunction()

set(pair "AskedOf<thinwall::Obb<double>, *thinwall::Triangle<double> *>")
expect_error(ONE_BY_ONE "this pair of shapes is not served" "${pair}")
expect_error(GROUPED "this pair of shapes is not served" "${pair}")
expect_error(CERTIFIED "this pair of shapes cannot be certified" "Certified${pair}")
expect_error(TURNING "an Aabb that turns is an Obb")
