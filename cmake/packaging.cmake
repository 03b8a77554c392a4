# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install and a Debian package. The man page is printed by the program itself: one text, two renderings.
set(man_page ${PROJECT_BINARY_DIR}/ridgecraft.1)
add_custom_command(OUTPUT ${man_page}
  COMMAND ridgecraft --man-page > ${man_page}
  DEPENDS ridgecraft
  VERBATIM)
add_custom_target(man_page ALL DEPENDS ${man_page})

install(TARGETS ridgecraft RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
install(DIRECTORY samples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/ridgecraft/samples
  FILES_MATCHING PATTERN "*.obj" PATTERN "*.mtl" PATTERN "*.stl" PATTERN "*.ply" PATTERN "*.off")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ridgecraft)
set(CPACK_PACKAGE_CONTACT "The Ridgecraft authors <ridgecraft@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
