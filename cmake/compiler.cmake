# SPDX-License-Identifier: GPL-3.0-or-later
# Compiler settings that every library of ours shares, as the interface target ridgecraft_options.
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
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Woverloaded-virtual
  -Wnon-virtual-dtor -Wdouble-promotion -Wimplicit-fallthrough
  # GCC 12 takes std::string + std::string for overlapping copies (bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(RIDGECRAFT_WERROR)
  # What the optimiser's flow analysis suspects is told, but depends on inlining and is often a false alarm of GCC 12.
  target_compile_options(ridgecraft_options INTERFACE -Werror -Wno-error=maybe-uninitialized
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=use-after-free> -Wno-error=array-bounds
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=stringop-overflow> $<$<CXX_COMPILER_ID:GNU>:-Wno-error=stringop-overread>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=free-nonheap-object>)
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
endif()
if(RIDGECRAFT_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# Headers that most files include are read once. Files must name what they use all the same: the fuzz build goes without.
option(RIDGECRAFT_PRECOMPILED "Precompile common headers" ON)

# ridgecraft_library(NAME SOURCES... [PUBLIC libs...] [PRIVATE libs...]): one folder, one static library.
function(ridgecraft_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(ridgecraft_${name} STATIC ${arg_SOURCES})
  add_library(ridgecraft::${name} ALIAS ridgecraft_${name})
  target_link_libraries(ridgecraft_${name} PUBLIC ridgecraft_options ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  if(RIDGECRAFT_PRECOMPILED)
    target_precompile_headers(ridgecraft_${name} PRIVATE
      <algorithm> <array> <cmath> <cstdint> <functional> <map> <memory> <numeric> <optional> <span> <string>
      <string_view> <utility> <vector>)
  endif()
endfunction()
