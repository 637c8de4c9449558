# hedgerow_install(TARGET EXPORT_NAME INCLUDE_FOLDER): puts a library and its public headers into the
# installed package, where consumers link it as hedgerow::EXPORT_NAME.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

function(hedgerow_install target export_name include_folder)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name})
  install(TARGETS ${target} EXPORT hedgerow-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(DIRECTORY ${include_folder}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.h")
endfunction()

# The package files; called once, after the last library.
function(hedgerow_install_package)
  set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/hedgerow)
  set(config ${PROJECT_BINARY_DIR}/hedgerow-config.cmake)
  set(version ${PROJECT_BINARY_DIR}/hedgerow-config-version.cmake)
  configure_package_config_file(
    ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/hedgerow-config.cmake.in ${config}
    INSTALL_DESTINATION ${folder} NO_SET_AND_CHECK_MACRO)
  # Before 1.0 any minor version may break its users, so only the same one is compatible.
  write_basic_package_version_file(${version} COMPATIBILITY SameMinorVersion)
  install(EXPORT hedgerow-targets NAMESPACE hedgerow:: DESTINATION ${folder})
  install(FILES ${config} ${version} DESTINATION ${folder})
endfunction()
