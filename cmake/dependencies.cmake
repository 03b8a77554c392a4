# SPDX-License-Identifier: GPL-3.0-or-later
# Everything comes from Debian 12 packages; cmake/packages.txt lists them. What no library that is built needs isn't
# looked for.
include(GNUInstallDirs)
find_package(PkgConfig REQUIRED)
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)

set(ridgecraft_packages "")
foreach(component IN LISTS ridgecraft_components)
  list(APPEND ridgecraft_packages ${ridgecraft_links_${component}} ${ridgecraft_reads_${component}})
endforeach()
list(REMOVE_DUPLICATES ridgecraft_packages)
# OpenMesh before CGAL, which changes where it is looked for.
if(OpenMesh IN_LIST ridgecraft_packages)
  list(REMOVE_ITEM ridgecraft_packages OpenMesh)
  list(PREPEND ridgecraft_packages OpenMesh)
endif()
foreach(package IN LISTS ridgecraft_packages)
  if(DEFINED ridgecraft_modules_${package})
    pkg_check_modules(${package} REQUIRED IMPORTED_TARGET ${ridgecraft_modules_${package}})
  else()
    find_package(${ridgecraft_find_${package}} REQUIRED)
  endif()
endforeach()
include(CGAL_Eigen3_support)

if(RIDGECRAFT_PROGRAM)
  find_package(CLI11 CONFIG REQUIRED)
endif()
if(RIDGECRAFT_TESTS)
  find_package(Catch2 2.13 CONFIG REQUIRED)
endif()
