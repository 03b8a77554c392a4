# SPDX-License-Identifier: GPL-3.0-or-later
# Compiler settings of our own code, as the interface target ridgecraft_options: libraries, programs and tests link it, and
# nothing of it reaches those who link the libraries.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

add_library(ridgecraft_options INTERFACE)
target_include_directories(ridgecraft_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(ridgecraft_options INTERFACE
  # Equal bytes on every machine: no fused multiply-add behind our back.
  -ffp-contract=off
  # Libraries may become a part of somebody's shared object; nobody replaces functions of theirs one by one, which is
  # what other compilers assume anyway.
  $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Woverloaded-virtual
  -Wnon-virtual-dtor -Wdouble-promotion -Wimplicit-fallthrough
  # GCC 12 takes std::string + std::string for overlapping copies (bug 105651). What else the flow analysis of its
  # optimiser suspects depends on what was inlined, and was a false alarm each of the 70 times that it spoke, all inside
  # std::string and std::vector; clang's address sanitizer looks for the same mistakes where they happen.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread
    -Wno-use-after-free -Wno-free-nonheap-object>
  # Clang takes INFINITY, which is a float, for a number that is widened by mistake.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-double-promotion>
  # GCC 12's library makes use of what it calls deprecated itself, in std::stable_sort; so does CGAL 5.5.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>
  # Pointers of WebAssembly have 32 bits: an iterator plus a std::uint32_t would be a conversion of signs there.
  $<$<PLATFORM_ID:Emscripten>:-Wno-sign-conversion>
  # Catch2 counts its tests by __COUNTER__, which clang 22 calls an extension.
  $<$<AND:$<CXX_COMPILER_ID:Clang>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,22>>:-Wno-c2y-extensions>)
if(RIDGECRAFT_WERROR)
  # This one is told, and stops nothing: it depends on what was inlined, too.
  target_compile_options(ridgecraft_options INTERFACE -Werror
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized>)
endif()
if(RIDGECRAFT_PORTABLE)
  # Everywhere, so that no two files see different types: tests of ours, too.
  add_compile_definitions(RIDGECRAFT_PORTABLE=1)
endif()
if(RIDGECRAFT_ASSERTIONS)
  target_compile_definitions(ridgecraft_options INTERFACE RIDGECRAFT_ASSERTIONS=1)
endif()
if(RIDGECRAFT_SANITIZE)
  # Light optimisation and debug information: full ones make the CGAL files seven times as slow to compile.
  add_compile_options(-O1 -g1 -fno-omit-frame-pointer -fsanitize=${RIDGECRAFT_SANITIZE})
  add_compile_options(-fno-sanitize-recover=all)
  add_compile_definitions(RIDGECRAFT_SANITIZED=1)
  if(RIDGECRAFT_SANITIZE MATCHES "undefined")
    # A null pointer stops the program anyway, and the others never spoke: a quarter of the time to compile.
    add_compile_options(-fno-sanitize=null,alignment,object-size,vptr)
  endif()
  add_link_options(-fsanitize=${RIDGECRAFT_SANITIZE})
  # Sixty programs, each with all that sanitizers need: GNU's linker takes three times as long.
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=lld ridgecraft_lld)
  if(ridgecraft_lld)
    add_link_options(-fuse-ld=lld)
  endif()
endif()

# Headers that most files include are read once. Files must name what they use all the same: .ci/tidy.sh
# goes without.
option(RIDGECRAFT_PRECOMPILED "Precompile common headers" ON)
set(ridgecraft_common_headers
  <algorithm> <array> <charconv> <cmath> <cstdint> <functional> <limits> <map> <memory> <numbers> <numeric> <optional>
  <set> <span> <string> <string_view> <tuple> <utility> <vector>)

# ridgecraft_precompile(TARGET OWNER HEADERS...): the headers are compiled with OWNER, the first target that asks, and
# read by all others, whose compiler settings must be the same.
function(ridgecraft_precompile target owner)
  if(NOT RIDGECRAFT_PRECOMPILED)
    return()
  endif()
  if(target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# Most of the compiler's time goes into the same few templates, again for every file. Files of one folder that are
# compiled as one unit share that work: good for a build from nothing, bad for one after a change. And it hides
# includes that are missing, so builds for daily work go without.
option(RIDGECRAFT_UNITY "Compile the files of a folder as one unit" OFF)

# ridgecraft_unity(TARGET SOURCES... [UNITS number]): UNITS divides a folder of very many files into so many units of
# like size, for the compiler's memory and so that several processes share the work.
function(ridgecraft_unity target)
  if(NOT RIDGECRAFT_UNITY)
    return()
  endif()
  cmake_parse_arguments(arg "" "UNITS" "" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  set(index 0)
  foreach(source IN LISTS arg_UNPARSED_ARGUMENTS)
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "folder_${folder}" group)
    if(arg_UNITS)
      math(EXPR unit "${index} % ${arg_UNITS} + 1")
      math(EXPR index "${index} + 1")
      string(APPEND group "_${unit}")
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()
if(RIDGECRAFT_UNITY)
  # A local name in one file may be the name of a function in another; and with all of a folder to inline, GCC 12 takes
  # the parts of a std::variant that aren't in use for ones that are read.
  target_compile_options(ridgecraft_options INTERFACE -Wno-shadow
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()

# Clang 20 and later look at templates of CGAL 5.5 that nobody uses, and find members missing there.
set(ridgecraft_cgal_options
  $<$<AND:$<CXX_COMPILER_ID:Clang>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,20>>:-fdelayed-template-parsing>
  $<$<AND:$<CXX_COMPILER_ID:Clang>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,20>>:-Wno-delayed-template-parsing-in-cxx20>)

# Libraries may become a part of somebody's shared object. A module of WebAssembly has none, and reaches its own variables
# by detours then.
set(ridgecraft_position_independent ON)
if(EMSCRIPTEN)
  set(ridgecraft_position_independent OFF)
endif()

# ridgecraft_library(NAME SOURCES... [PUBLIC_HEADERS...] [CGAL_SOURCES...] [CGAL_PRIVATE libs...] [PUBLIC libs...]
# [PRIVATE libs...] [READS libs...]): one folder, one static library. All may use fmt. PUBLIC_HEADERS are those that
# others may include (cmake/headers.cmake). READS are libraries of headers that nobody needs who links the archive. What
# includes CGAL is compiled apart: CGAL asks for compiler settings of its own, with which headers that were compiled for
# the others can't be read. (Its kernel precompiled is 450 MB and takes longer than it saves.)
function(ridgecraft_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC_HEADERS;CGAL_SOURCES;CGAL_PRIVATE;PUBLIC;PRIVATE;READS" ${ARGN})
  add_library(ridgecraft_${name} STATIC ${arg_SOURCES})
  add_library(Ridgecraft::${name} ALIAS ridgecraft_${name})
  set_target_properties(ridgecraft_${name} PROPERTIES EXPORT_NAME ${name}
    POSITION_INDEPENDENT_CODE ${ridgecraft_position_independent})
  target_compile_features(ridgecraft_${name} PUBLIC cxx_std_20)
  target_include_directories(ridgecraft_${name} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(ridgecraft_${name} PUBLIC ${arg_PUBLIC} PRIVATE fmt::fmt ${arg_PRIVATE})
  foreach(settings_or_headers IN ITEMS ridgecraft_options ${arg_READS})
    target_link_libraries(ridgecraft_${name} PRIVATE $<BUILD_INTERFACE:${settings_or_headers}>)
  endforeach()
  ridgecraft_precompile(ridgecraft_${name} ridgecraft_base ${ridgecraft_common_headers} <fmt/format.h>)
  ridgecraft_unity(ridgecraft_${name} ${arg_SOURCES})
  if(RIDGECRAFT_FUZZ)
    # Fuzz targets tell by what the libraries do which inputs are new.
    target_compile_options(ridgecraft_${name} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
  if(arg_CGAL_SOURCES)
    add_library(ridgecraft_${name}_cgal OBJECT ${arg_CGAL_SOURCES})
    set_target_properties(ridgecraft_${name}_cgal PROPERTIES
      POSITION_INDEPENDENT_CODE ${ridgecraft_position_independent})
    target_compile_options(ridgecraft_${name}_cgal PRIVATE ${ridgecraft_cgal_options})
    target_link_libraries(ridgecraft_${name}_cgal PRIVATE
      ridgecraft_options ${arg_CGAL_PRIVATE} CGAL::CGAL CGAL::Eigen3_support Boost::headers)
    # Sums in the order in which they are written, whatever the processor's registers hold.
    target_compile_definitions(ridgecraft_${name}_cgal PRIVATE EIGEN_DONT_VECTORIZE)
    ridgecraft_unity(ridgecraft_${name}_cgal ${arg_CGAL_SOURCES})
    target_sources(ridgecraft_${name} PRIVATE $<TARGET_OBJECTS:ridgecraft_${name}_cgal>)
    target_link_libraries(ridgecraft_${name} PRIVATE ${arg_CGAL_PRIVATE} PkgConfig::mpfr PkgConfig::gmp)
  endif()
  list(TRANSFORM arg_PUBLIC_HEADERS PREPEND ${name}/)
  set_property(GLOBAL APPEND PROPERTY RIDGECRAFT_PUBLIC_HEADERS ${arg_PUBLIC_HEADERS})
endfunction()
