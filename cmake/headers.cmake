# SPDX-License-Identifier: GPL-3.0-or-later
# The headers that others include, as <ridgecraft/segment/segment.hpp>. Inside the repository a header names others from
# the root, "mesh/model/surface.hpp", which could be anybody's: what others get are copies that say ridgecraft/ before it.
# They lie below include/ in the build folder, for projects that have this one as a part, and are installed from there.
get_property(ridgecraft_headers GLOBAL PROPERTY RIDGECRAFT_PUBLIC_HEADERS)
set(ridgecraft_include_folder ${PROJECT_BINARY_DIR}/include)
set(ridgecraft_header_copies ${ridgecraft_headers})
list(TRANSFORM ridgecraft_header_copies PREPEND ${ridgecraft_include_folder}/ridgecraft/)
set(ridgecraft_header_sources ${ridgecraft_headers})
list(TRANSFORM ridgecraft_header_sources PREPEND ${PROJECT_SOURCE_DIR}/)
list(JOIN ridgecraft_headers "," ridgecraft_header_names)
add_custom_command(OUTPUT ${ridgecraft_include_folder}/headers.stamp
  COMMAND ${CMAKE_COMMAND} -DFROM=${PROJECT_SOURCE_DIR} -DTO=${ridgecraft_include_folder}/ridgecraft
    -DHEADERS=${ridgecraft_header_names} -P ${PROJECT_SOURCE_DIR}/cmake/copy_headers.cmake
  COMMAND ${CMAKE_COMMAND} -E touch ${ridgecraft_include_folder}/headers.stamp
  BYPRODUCTS ${ridgecraft_header_copies}
  DEPENDS ${ridgecraft_header_sources} ${PROJECT_SOURCE_DIR}/cmake/copy_headers.cmake
  COMMENT "Copying public headers"
  VERBATIM)
add_custom_target(ridgecraft_headers ALL DEPENDS ${ridgecraft_include_folder}/headers.stamp)
# Whoever links a library of ours may include these.
add_dependencies(ridgecraft_base ridgecraft_headers)
