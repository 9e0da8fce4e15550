# Finds each dependency on the system, or fetches a pinned release of it if THINWALL_FETCH is on.
#
# thinwall_dependency(NAME) looks for NAME and remembers it if it is missing; thinwall_stop_if_missing() then names
# every missing package at once. thinwall_version_NAME holds the version found.

# The CMake target we link for each dependency, its Debian package, and where a pinned release comes from.
# HEADERS names the folder of a header-only release: it is used as it is and its own build is not run.
macro(thinwall_describe name)
  cmake_parse_arguments(dep "" "TARGET;DEBIAN;MINIMUM;HEADERS;PROBE" "SOURCE" ${ARGN})
endmacro()

macro(thinwall_lookup name)
  if(${name} STREQUAL Eigen3)
    thinwall_describe(Eigen3 TARGET Eigen3::Eigen DEBIAN libeigen3-dev MINIMUM 3.4 HEADERS .
      SOURCE GIT_REPOSITORY https://gitlab.com/libeigen/eigen.git GIT_TAG 3.4.0)
  elseif(${name} STREQUAL Boost)
    thinwall_describe(Boost TARGET Boost::headers DEBIAN libboost-dev MINIMUM 1.74 HEADERS .
      SOURCE URL https://archives.boost.io/release/1.74.0/source/boost_1_74_0.tar.bz2
      URL_HASH SHA256=83bfc1507731a0906e387fc28b7ef5417d591429e51e788417fe9ff025e116b1)
  elseif(${name} STREQUAL CLI11)
    thinwall_describe(CLI11 TARGET CLI11::CLI11 DEBIAN libcli11-dev MINIMUM 2.1 HEADERS include
      SOURCE GIT_REPOSITORY https://github.com/CLIUtils/CLI11.git GIT_TAG v2.1.2)
  elseif(${name} STREQUAL tomlplusplus)
    thinwall_describe(tomlplusplus TARGET tomlplusplus::tomlplusplus DEBIAN libtomlplusplus-dev MINIMUM 3.3 HEADERS include
      SOURCE GIT_REPOSITORY https://github.com/marzer/tomlplusplus.git GIT_TAG v3.3.0)
  elseif(${name} STREQUAL nlohmann_json)
    thinwall_describe(nlohmann_json TARGET nlohmann_json::nlohmann_json DEBIAN nlohmann-json3-dev MINIMUM 3.11 HEADERS include
      SOURCE GIT_REPOSITORY https://github.com/nlohmann/json.git GIT_TAG v3.11.2)
  elseif(${name} STREQUAL Random123)
    thinwall_describe(Random123 TARGET Random123::Random123 DEBIAN librandom123-dev HEADERS include PROBE Random123/philox.h
      SOURCE GIT_REPOSITORY https://github.com/DEShawResearch/random123.git GIT_TAG v1.14.0)
  elseif(${name} STREQUAL fmt)
    thinwall_describe(fmt TARGET fmt::fmt DEBIAN libfmt-dev MINIMUM 9
      SOURCE GIT_REPOSITORY https://github.com/fmtlib/fmt.git GIT_TAG 9.1.0)
  elseif(${name} STREQUAL md4c)
    thinwall_describe(md4c TARGET md4c::md4c-html DEBIAN "libmd4c-dev libmd4c-html0-dev"
      SOURCE GIT_REPOSITORY https://github.com/mity/md4c.git GIT_TAG release-0.4.8)
  elseif(${name} STREQUAL OpenSSL)  # the system's, as EXPAT is: neither is fetched
    thinwall_describe(OpenSSL TARGET OpenSSL::Crypto DEBIAN libssl-dev MINIMUM 3.0)
  elseif(${name} STREQUAL EXPAT)
    thinwall_describe(EXPAT TARGET EXPAT::EXPAT DEBIAN libexpat1-dev MINIMUM 2.4)
  elseif(${name} STREQUAL TBB)
    thinwall_describe(TBB TARGET TBB::tbb DEBIAN libtbb-dev MINIMUM 2021
      SOURCE GIT_REPOSITORY https://github.com/oneapi-src/oneTBB.git GIT_TAG v2021.8.0)
  elseif(${name} STREQUAL hwy)
    thinwall_describe(hwy TARGET hwy::hwy DEBIAN libhwy-dev MINIMUM 1.0
      SOURCE GIT_REPOSITORY https://github.com/google/highway.git GIT_TAG 1.0.3)
  elseif(${name} STREQUAL GTest)
    thinwall_describe(GTest TARGET GTest::gtest_main DEBIAN libgtest-dev
      SOURCE GIT_REPOSITORY https://github.com/google/googletest.git GIT_TAG release-1.12.1)
  elseif(${name} STREQUAL rapidcheck)  # has no releases: the commit of 2023-12-14
    thinwall_describe(rapidcheck TARGET rapidcheck_gtest DEBIAN librapidcheck-dev
      SOURCE GIT_REPOSITORY https://github.com/emil-e/rapidcheck.git GIT_TAG ff6af6fc683159deb51c543b065eba14dfcf329b)
  elseif(${name} STREQUAL benchmark)
    thinwall_describe(benchmark TARGET benchmark::benchmark_main DEBIAN libbenchmark-dev
      SOURCE GIT_REPOSITORY https://github.com/google/benchmark.git GIT_TAG v1.7.1)
  else()
    message(FATAL_ERROR "thinwall_dependency: unknown dependency '${name}'")
  endif()
endmacro()

function(thinwall_dependency name)
  if(DEFINED thinwall_version_${name})
    return()  # two parts need it
  endif()
  thinwall_lookup(${name})
  set(origin "")
  if(TARGET ${dep_TARGET})
    set(origin "already a target")
  elseif(dep_PROBE)  # headers that come without a CMake package
    find_path(THINWALL_${name}_INCLUDE_DIR ${dep_PROBE})
    if(THINWALL_${name}_INCLUDE_DIR)
      thinwall_interface(${dep_TARGET} "${THINWALL_${name}_INCLUDE_DIR}")
      set(origin "found")
    endif()
  else()
    if(POLICY CMP0167)
      cmake_policy(SET CMP0167 NEW)  # Boost brings its own package file
    endif()
    find_package(${name} ${dep_MINIMUM} QUIET GLOBAL)  # for a project that adds this one, too
    if(TARGET ${dep_TARGET})
      set(origin "found")
    endif()
  endif()
  if(NOT origin AND THINWALL_FETCH AND dep_SOURCE)
    thinwall_fetch(${name})
    set(origin "fetched")
  endif()
  if(NOT origin)
    set_property(GLOBAL APPEND PROPERTY thinwall_missing "${name} (${dep_DEBIAN})")
    set_property(GLOBAL APPEND PROPERTY thinwall_missing_debian "${dep_DEBIAN}")
    return()
  endif()
  string(TOUPPER ${name} upper)  # as CMake's own modules spell it
  foreach(variable IN ITEMS ${name}_VERSION ${upper}_VERSION ${upper}_VERSION_STRING)
    if(NOT version)
      set(version "${${variable}}")
    endif()
  endforeach()
  if(NOT version AND origin STREQUAL "fetched")
    string(REGEX MATCH "[0-9]+[.][0-9]+[.][0-9]+" version "${dep_SOURCE}")
  endif()
  set(thinwall_version_${name} "${version}" PARENT_SCOPE)
  message(STATUS "${name}: ${origin} ${version}")
endfunction()

function(thinwall_fetch name)
  include(FetchContent)
  string(TOLOWER "thinwall_${name}" fetched)
  list(JOIN dep_SOURCE " " from)
  message(STATUS "${name}: fetching ${from}")
  # SOURCE_SUBDIR names no folder: download only, so that we decide below how the release is built.
  FetchContent_Declare(${fetched} ${dep_SOURCE} SOURCE_SUBDIR none DOWNLOAD_EXTRACT_TIMESTAMP ON)
  FetchContent_MakeAvailable(${fetched})
  set(source "${${fetched}_SOURCE_DIR}")
  if(dep_HEADERS)
    thinwall_interface(${dep_TARGET} "${source}/${dep_HEADERS}")
    return()
  endif()
  foreach(off IN ITEMS TBB_TEST TBB_STRICT BENCHMARK_ENABLE_TESTING BENCHMARK_ENABLE_GTEST_TESTS
                       BENCHMARK_ENABLE_INSTALL BENCHMARK_ENABLE_WERROR INSTALL_GTEST
                       HWY_ENABLE_CONTRIB HWY_ENABLE_EXAMPLES HWY_ENABLE_INSTALL HWY_ENABLE_TESTS)
    set(${off} OFF)
  endforeach()
  set(RC_ENABLE_GTEST ON)
  set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)  # the settings above win over the release's own defaults
  set(CMAKE_POLICY_VERSION_MINIMUM 3.5)
  add_subdirectory("${source}" "${${fetched}_BINARY_DIR}" EXCLUDE_FROM_ALL SYSTEM)
  if(NOT TARGET ${dep_TARGET})  # its name behind the namespace of its package
    string(REGEX REPLACE "^.*::" "" plain "${dep_TARGET}")
    target_include_directories(${plain} SYSTEM INTERFACE "${source}/src")
    add_library(${dep_TARGET} ALIAS ${plain})
  endif()
endfunction()

function(thinwall_interface target folder)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE "${folder}")
endfunction()

function(thinwall_stop_if_missing)
  get_property(missing GLOBAL PROPERTY thinwall_missing)
  if(missing)
    get_property(packages GLOBAL PROPERTY thinwall_missing_debian)
    list(JOIN missing ", " missing)
    list(JOIN packages " " packages)
    message(FATAL_ERROR
      "thinwall needs, and did not find: ${missing}.\n"
      "On Debian or Ubuntu: apt-get install ${packages}\n"
      "Elsewhere: add -DTHINWALL_FETCH=ON, and CMake downloads pinned releases of what is missing, but of OpenSSL and Expat.")
  endif()
endfunction()
