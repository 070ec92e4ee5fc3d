# cmake --install and find_package(welkin): the layers as static libraries, their headers, the shaders with the headers that
# they share, the scenes.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

add_library(welkin_all INTERFACE)  # welkin::welkin is all that another program links
set_target_properties(welkin_all PROPERTIES EXPORT_NAME welkin)
target_link_libraries(welkin_all INTERFACE welkin_app)

set(layers core shared physics clouds octree reference stream gpu render measure app)
list(TRANSFORM layers PREPEND welkin_ OUTPUT_VARIABLE layer_targets)
install(TARGETS ${layer_targets} welkin_all welkin_glad welkin_lodepng EXPORT welkinTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(layer ${layers})
  if(EXISTS ${CMAKE_SOURCE_DIR}/src/${layer}/include)
    install(DIRECTORY src/${layer}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  endif()
endforeach()
install(DIRECTORY ${GLAD_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/welkin/glad-4.5)
install(DIRECTORY shaders/ DESTINATION ${CMAKE_INSTALL_DATADIR}/welkin/shaders)
install(DIRECTORY src/shared/include/ DESTINATION ${CMAKE_INSTALL_DATADIR}/welkin/shaders/include)
install(FILES cmake/welkin_shader_folder.cpp DESTINATION ${CMAKE_INSTALL_DATADIR}/welkin)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/welkin)
install(DIRECTORY data DESTINATION ${CMAKE_INSTALL_DATADIR}/welkin)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TARGET welkin)
  install(TARGETS welkin RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)
install(EXPORT welkinTargets NAMESPACE welkin:: DESTINATION ${package_folder})
configure_package_config_file(cmake/welkinConfig.cmake.in ${CMAKE_BINARY_DIR}/welkinConfig.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/welkinConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/welkinConfig.cmake ${CMAKE_BINARY_DIR}/welkinConfigVersion.cmake DESTINATION ${package_folder})

if(WELKIN_TESTS)
  if(TARGET welkin AND TARGET welkin_render AND NOT WELKIN_SANITIZE AND NOT WELKIN_TSAN)
    add_test(NAME install_and_example
      COMMAND ${CMAKE_SOURCE_DIR}/tests/install/install_and_example.sh ${CMAKE_BINARY_DIR} ${CMAKE_SOURCE_DIR} ${CMAKE_COMMAND})
    set_tests_properties(install_and_example PROPERTIES TIMEOUT 600)
  endif()
endif()
