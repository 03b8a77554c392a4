# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install and Debian packages: `program` is the program with all that its user reads, `development` what other
# programs link, and find_package(Ridgecraft).
set(ridgecraft_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Ridgecraft)

if(RIDGECRAFT_PROGRAM)
  # The man page is printed by the program itself: one text, two renderings.
  set(man_page ${PROJECT_BINARY_DIR}/ridgecraft.1)
  add_custom_command(OUTPUT ${man_page}
    COMMAND ridgecraft --man-page > ${man_page}
    DEPENDS ridgecraft
    VERBATIM)
  add_custom_target(man_page ALL DEPENDS ${man_page})
  install(TARGETS ridgecraft RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  if(ridgecraft_import)
    # Not on the path: nobody calls it but the program.
    install(TARGETS ridgecraft-import RUNTIME DESTINATION libexec/ridgecraft COMPONENT program)
  endif()
  install(FILES ${man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
  install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT program
    FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
  install(DIRECTORY samples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/ridgecraft/samples COMPONENT program
    FILES_MATCHING PATTERN "*.obj" PATTERN "*.mtl" PATTERN "*.stl" PATTERN "*.ply" PATTERN "*.off")
  # What wasm/build.sh makes, where it did: `ridgecraft studio` looks for it there.
  install(FILES build/wasm/studio.html DESTINATION ${CMAKE_INSTALL_DATADIR}/ridgecraft COMPONENT program OPTIONAL)
endif()

# One set of targets per library, so that whoever wants one reads nothing of those above it.
foreach(component IN LISTS ridgecraft_components)
  install(TARGETS ridgecraft_${component} EXPORT ridgecraft_${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT ridgecraft_${component} FILE RidgecraftTargets-${component}.cmake NAMESPACE Ridgecraft::
    DESTINATION ${ridgecraft_package_folder} COMPONENT development)
endforeach()
install(DIRECTORY ${ridgecraft_include_folder}/ridgecraft DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
include(CMakePackageConfigHelpers)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/RidgecraftConfig.cmake.in
  ${PROJECT_BINARY_DIR}/RidgecraftConfig.cmake INSTALL_DESTINATION ${ridgecraft_package_folder})
# Semantic versioning: before 1.0 each minor version may change what is public (CHANGELOG.md says what did).
write_basic_package_version_file(${PROJECT_BINARY_DIR}/RidgecraftConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/RidgecraftConfig.cmake ${PROJECT_BINARY_DIR}/RidgecraftConfigVersion.cmake
  DESTINATION ${ridgecraft_package_folder} COMPONENT development)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/components.cmake DESTINATION ${ridgecraft_package_folder}
  RENAME RidgecraftComponents.cmake COMPONENT development)

if(PROJECT_IS_TOP_LEVEL AND RIDGECRAFT_PROGRAM)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME ridgecraft)
  set(CPACK_PACKAGE_CONTACT "The Ridgecraft authors <ridgecraft@localhost>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
  set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_COMPONENTS_ALL program development)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME ridgecraft)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libridgecraft-dev)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "pkg-config, libgmp-dev, libmpfr-dev, libfmt-dev, libpugixml-dev, libjpeg62-turbo-dev, libpng-dev, libwebp-dev, libtiff-dev, libdraco-dev, libmeshoptimizer-dev, zlib1g-dev")
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "libopenmesh-dev, libqpdf-dev, libcairo2-dev")
  set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Libraries and headers of Ridgecraft, for programs that segment and unfold")
  set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${PROJECT_DESCRIPTION}")
  include(CPack)
endif()
