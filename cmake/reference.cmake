# SPDX-License-Identifier: GPL-3.0-or-later
# The target `reference`: pages of HTML about the public headers, in reference/ of the build folder, by Doxygen.
if(PROJECT_IS_TOP_LEVEL)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(reference
    COMMAND doxygen ${PROJECT_BINARY_DIR}/Doxyfile
    DEPENDS ridgecraft_headers
    COMMENT "Writing the reference"
    VERBATIM)
endif()
