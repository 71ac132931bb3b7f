# What `cmake --install` puts where. Components: `programs`, `library`, `development`. A prefix can
# be moved, and no file in it says where it was built: paths between its files are relative.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/twincraft)
set(share_folder ${CMAKE_INSTALL_DATADIR}/twincraft)

file(RELATIVE_PATH from_bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set_target_properties(scsim sccompile PROPERTIES INSTALL_RPATH $ORIGIN/${from_bin_to_lib})
set_target_properties(twincraft PROPERTIES INSTALL_RPATH $ORIGIN)

install(TARGETS scsim sccompile RUNTIME COMPONENT programs)
# The schema is where the models' first lines say that it is.
install(DIRECTORY models schemas DESTINATION ${share_folder} COMPONENT programs)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)

install(TARGETS twincraft EXPORT twincraftTargets
        LIBRARY COMPONENT library NAMELINK_COMPONENT development
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY runtime/api/include/ TYPE INCLUDE COMPONENT development)
install(DIRECTORY examples DESTINATION ${share_folder} COMPONENT development
        PATTERN __pycache__ EXCLUDE PATTERN build EXCLUDE)
install(EXPORT twincraftTargets NAMESPACE twincraft:: DESTINATION ${package_folder}
        COMPONENT development)

configure_package_config_file(cmake/package/twincraftConfig.cmake.in twincraftConfig.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS CMAKE_INSTALL_BINDIR
  NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/twincraftConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/twincraftConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/twincraftConfigVersion.cmake
              cmake/package/twincraftFunctions.cmake
        DESTINATION ${package_folder} COMPONENT development)

file(RELATIVE_PATH from_pkgconfig_to_prefix
     ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" from_pkgconfig_to_prefix ${from_pkgconfig_to_prefix})
configure_file(cmake/package/twincraft.pc.in twincraft.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/twincraft.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
