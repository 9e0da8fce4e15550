# Other people's libraries, measured beside ours where THINWALL_PEERS asks for it and they are installed. Each one found becomes
# an imported target thinwall_peers::NAME, which also defines THINWALL_HAS_NAME: an adapter compiles to nothing without it. What
# is missing is named here and left out. Neither the headers nor the installed package know of any of them.
#
# thinwall_version_NAME holds the version found, thinwall_peers the names found.

# thinwall_peer(NAME CALLED PACKAGE HEADER LIBRARIES [PC] [FOLDER] [LINKS]): looks for one, CALLED so by people. PC is its file for
# pkg-config, which knows the version; FOLDER is where the header lies below an include folder; LINKS are targets it needs.
function(thinwall_peer name)
  cmake_parse_arguments(PARSE_ARGV 1 peer "" "CALLED;PACKAGE;HEADER;PC;FOLDER" "LIBRARIES;LINKS")
  string(TOUPPER "${name}" upper)
  find_path(THINWALL_${upper}_INCLUDE_DIR "${peer_HEADER}" PATH_SUFFIXES ${peer_FOLDER})
  set(parts "${THINWALL_${upper}_INCLUDE_DIR}")
  set(libraries "")
  foreach(library IN LISTS peer_LIBRARIES)
    find_library(THINWALL_LIBRARY_${library} ${library})
    list(APPEND parts "${THINWALL_LIBRARY_${library}}")
    list(APPEND libraries "${THINWALL_LIBRARY_${library}}")
  endforeach()
  foreach(link IN LISTS peer_LINKS)
    if(NOT TARGET ${link})
      list(APPEND parts "${link}-NOTFOUND")
    endif()
  endforeach()
  if("${parts}" MATCHES "NOTFOUND")
    message(STATUS "Peer ${peer_CALLED}: missing, left out (Debian: ${peer_PACKAGE})")
    return()
  endif()
  set(version "")
  list(GET libraries 0 first)
  cmake_path(GET first PARENT_PATH folder)
  if(EXISTS "${folder}/pkgconfig/${peer_PC}.pc")
    file(STRINGS "${folder}/pkgconfig/${peer_PC}.pc" version REGEX "^Version:")
    string(REGEX REPLACE "^Version: *" "" version "${version}")
  endif()
  add_library(thinwall_peers::${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(thinwall_peers::${name} SYSTEM INTERFACE "${THINWALL_${upper}_INCLUDE_DIR}")
  target_link_libraries(thinwall_peers::${name} INTERFACE ${libraries} ${peer_LINKS})
  target_compile_definitions(thinwall_peers::${name} INTERFACE THINWALL_HAS_${upper})
  message(STATUS "Peer ${peer_CALLED}: found ${version}")
  set(thinwall_version_${peer_CALLED} "${version}" PARENT_SCOPE)
  set(thinwall_peers ${thinwall_peers} ${name} PARENT_SCOPE)
endfunction()

# thinwall_adapters(TARGET PEER): the sources FOLDER/PEER.cpp of this directory adapt it. They alone see it, and all others are
# compiled as they are without.
function(thinwall_adapters target peer)
  file(GLOB adapters "*/${peer}.cpp")
  if(NOT adapters)
    return()
  endif()
  get_target_property(folders thinwall_peers::${peer} INTERFACE_INCLUDE_DIRECTORIES)
  list(REMOVE_ITEM folders ${CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES})  # -isystem would reorder them
  list(TRANSFORM folders PREPEND "-isystem")
  get_target_property(definitions thinwall_peers::${peer} INTERFACE_COMPILE_DEFINITIONS)
  set_source_files_properties(${adapters} PROPERTIES
    COMPILE_DEFINITIONS "${definitions}" COMPILE_OPTIONS "${folders}")
  target_link_libraries(${target} PRIVATE $<LINK_ONLY:thinwall_peers::${peer}>)
endfunction()

set(thinwall_peers "")
if(THINWALL_PEERS)
  thinwall_peer(bullet CALLED Bullet PACKAGE libbullet-dev FOLDER bullet HEADER btBulletDynamicsCommon.h PC bullet
    LIBRARIES BulletDynamics BulletCollision LinearMath)
  thinwall_peer(ode CALLED ODE PACKAGE libode-dev HEADER ode/ode.h PC ode LIBRARIES ode)
  thinwall_peer(ccd CALLED libccd PACKAGE libccd-dev HEADER ccd/ccd.h PC ccd LIBRARIES ccd)
  thinwall_peer(fcl CALLED FCL PACKAGE libfcl-dev HEADER fcl/fcl.h PC fcl LIBRARIES fcl
    LINKS thinwall_peers::ccd Eigen3::Eigen)
  thinwall_peer(box2d CALLED Box2D PACKAGE libbox2d-dev HEADER box2d/box2d.h PC box2d LIBRARIES box2d)
endif()
