# Installing, and the package that find_package(thinwall COMPONENTS discrete capsule swept certified compiled batch) finds.
include(CMakePackageConfigHelpers)

foreach(folder IN ITEMS discrete capsule swept)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/thinwall/${folder}"
    FILES_MATCHING PATTERN "*.hpp")
endforeach()
if(TARGET thinwall AND THINWALL_BUILD_PROGRAM)
  install(TARGETS thinwall RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/thinwall")
set(thinwall_components discrete capsule swept certified compiled)
if(THINWALL_BUILD_BATCH)
  list(APPEND thinwall_components batch)
endif()
list(TRANSFORM thinwall_components PREPEND thinwall_ OUTPUT_VARIABLE component_targets)
install(TARGETS ${component_targets} EXPORT thinwall-targets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT thinwall-targets NAMESPACE thinwall:: DESTINATION "${package_folder}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/thinwall-config.cmake.in" thinwall-config.cmake
  INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file(thinwall-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/thinwall-config.cmake" "${CMAKE_CURRENT_BINARY_DIR}/thinwall-config-version.cmake"
  DESTINATION "${package_folder}")
