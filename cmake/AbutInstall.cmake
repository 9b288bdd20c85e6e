# Install rules: find_package(abut COMPONENTS contact) gives abut::contact, find_package(abut) also abut::abut.
include(CMakePackageConfigHelpers)
set(ABUT_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/abut)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/abut DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")

install(TARGETS abut_contact abut_simd EXPORT abutContactTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT abutContactTargets NAMESPACE abut:: DESTINATION ${ABUT_CONFIG_DIR})

if(NOT ABUT_CONTACT_ONLY)
  set_target_properties(abut_abut PROPERTIES EXPORT_NAME abut)
  get_property(stage_targets GLOBAL PROPERTY ABUT_STAGES)
  list(REMOVE_ITEM stage_targets abut_contact abut_simd abut_report)  # the report is the program's own, and needs VTK
  install(TARGETS ${stage_targets} abut_abut EXPORT abutTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT abutTargets NAMESPACE abut:: DESTINATION ${ABUT_CONFIG_DIR})
  install(TARGETS abut_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(FILES ${PROJECT_SOURCE_DIR}/docs/man/abut.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${PROJECT_SOURCE_DIR}/docs/man/abut.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME abut)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/abutConfig.cmake.in ${PROJECT_BINARY_DIR}/abutConfig.cmake
  INSTALL_DESTINATION ${ABUT_CONFIG_DIR} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/abutConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/abutConfig.cmake ${PROJECT_BINARY_DIR}/abutConfigVersion.cmake DESTINATION ${ABUT_CONFIG_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
