# SPDX-License-Identifier: GPL-3.0-or-later
# What cmake/dependencies.cmake finds on other systems: the libraries that the program stands on, compiled from Debian's
# sources (sources.sh) with the names that find_package would give them, and those that are headers alone.
enable_language(C)
set(from ${PROJECT_BINARY_DIR}/sources CACHE PATH "Where sources.sh has put the sources of libraries")
set(made ${PROJECT_BINARY_DIR}/libraries)

# ridgecraft_foreign_library(NAME SOURCES... [AS names...] [READS folders...] [OFFERS folders...] [DEFINES definitions...]
# [LINKS libraries...]): code of others, whose warnings are theirs.
function(ridgecraft_foreign_library name)
  cmake_parse_arguments(arg "" "AS" "SOURCES;READS;OFFERS;DEFINES;LINKS" ${ARGN})
  add_library(${name} STATIC EXCLUDE_FROM_ALL ${arg_SOURCES})
  target_include_directories(${name} PRIVATE ${arg_READS})
  target_include_directories(${name} SYSTEM INTERFACE ${arg_OFFERS})
  target_compile_definitions(${name} PRIVATE ${arg_DEFINES})
  target_compile_options(${name} PRIVATE -w -ffp-contract=off)
  target_compile_features(${name} PRIVATE cxx_std_17)
  target_link_libraries(${name} PUBLIC ${arg_LINKS})
  if(arg_AS)
    add_library(${arg_AS} ALIAS ${name})
  endif()
endfunction()

# ridgecraft_members(OUT FOLDER NAMES...): the files FOLDER/NAME.
function(ridgecraft_members out folder)
  list(TRANSFORM ARGN PREPEND ${folder}/)
  set(${out} ${ARGN} PARENT_SCOPE)
endfunction()

# Headers alone. The folder of the system's headers as a whole would put those of its C library before emscripten's.
set(headers ${made}/include)
file(MAKE_DIRECTORY ${headers})
foreach(library IN ITEMS boost CGAL fmt CLI nlohmann stb eigen3/Eigen)
  get_filename_component(name ${library} NAME)
  if(NOT EXISTS /usr/include/${library})
    message(FATAL_ERROR "There is no /usr/include/${library}: cmake/packages.txt lists the packages to install")
  endif()
  file(CREATE_LINK /usr/include/${library} ${headers}/${name} SYMBOLIC)
endforeach()
foreach(library IN ITEMS Boost::headers CLI11::CLI11 nlohmann_json::nlohmann_json Eigen3::Eigen CGAL::Eigen3_support
    fmt::fmt CGAL::CGAL Threads::Threads PkgConfig::gmp PkgConfig::mpfr)
  add_library(${library} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${library} SYSTEM INTERFACE ${headers})
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
# No GMP, and no rounding modes: exact numbers are Boost's, and intervals are widened by a unit in the last place.
target_compile_definitions(CGAL::CGAL INTERFACE CGAL_DISABLE_GMP CGAL_ALWAYS_ROUND_TO_NEAREST CGAL_NO_AUTOLINK)
target_compile_definitions(CGAL::Eigen3_support INTERFACE CGAL_EIGEN3_ENABLED)

file(GLOB sources ${from}/zlib/*.c)
ridgecraft_foreign_library(zlib AS ZLIB::ZLIB SOURCES ${sources} OFFERS ${from}/zlib READS ${from}/zlib
  DEFINES HAVE_UNISTD_H)

file(MAKE_DIRECTORY ${made}/png)
file(COPY_FILE ${from}/libpng1.6/scripts/pnglibconf.h.prebuilt ${made}/png/pnglibconf.h ONLY_IF_DIFFERENT)
ridgecraft_members(sources ${from}/libpng1.6 png.c pngerror.c pngget.c pngmem.c pngpread.c pngread.c pngrio.c pngrtran.c
  pngrutil.c pngset.c pngtrans.c pngwio.c pngwrite.c pngwtran.c pngwutil.c)
ridgecraft_foreign_library(png AS PNG::PNG SOURCES ${sources} OFFERS ${from}/libpng1.6 ${made}/png
  READS ${from}/libpng1.6 ${made}/png LINKS ZLIB::ZLIB)

ridgecraft_foreign_library(pugixml AS pugixml::pugixml SOURCES ${from}/pugixml/src/pugixml.cpp OFFERS ${from}/pugixml/src
  READS ${from}/pugixml/src)

file(GLOB sources ${from}/openmesh/src/OpenMesh/Core/Mesh/*.cc ${from}/openmesh/src/OpenMesh/Core/System/omstream.cc
  ${from}/openmesh/src/OpenMesh/Core/Utils/BaseProperty.cc ${from}/openmesh/src/OpenMesh/Core/Utils/Endian.cc)
ridgecraft_foreign_library(OpenMeshCore SOURCES ${sources} OFFERS ${from}/openmesh/src READS ${from}/openmesh/src)

include(${CMAKE_CURRENT_LIST_DIR}/jpeg.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/cairo.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/qpdf.cmake)

# For what follows, before libc++'s own headers: what it lacks.
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:-isystem${CMAKE_CURRENT_LIST_DIR}/compat>")
