# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D NM=nm -D LIBRARIES=a.a,b.a -P own_functions.cmake: fails where a library calls an elementary function of the
# system, whose last bits differ from machine to machine (base/elementary.hpp). Functions that are exact may be called.
cmake_minimum_required(VERSION 3.25)
set(not_exact sin cos tan sincos asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 exp10 expm1 log log2
  log10 log1p pow hypot cbrt erf erfc tgamma lgamma)
# CGAL's own calls: a limit of one degree that collapses are held against, and points at random on spheres.
set(calls_of_cgal "libridgecraft_prepare.a: collapse_sequence.cpp.o calls cos")
foreach(file IN ITEMS wrap.cpp.o unity_folder__cxx.cxx.o)  # which has it where folders are compiled as one unit
  list(APPEND calls_of_cgal "libridgecraft_solid.a: ${file} calls log" "libridgecraft_solid.a: ${file} calls sincos")
endforeach()
string(REPLACE "," ";" LIBRARIES "${LIBRARIES}")
set(names "")
foreach(function IN LISTS not_exact)
  list(APPEND names ${function} ${function}f ${function}l)
endforeach()
set(found "")
foreach(library IN LISTS LIBRARIES)
  execute_process(COMMAND ${NM} --undefined-only --print-file-name --format=posix ${library} OUTPUT_VARIABLE symbols
    ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
  # Brackets would keep CMake from taking the lines apart.
  string(REGEX REPLACE "[][]" " " symbols "${symbols}")
  string(REPLACE "\n" ";" lines "${symbols}")
  foreach(line IN LISTS lines)
    if(line MATCHES "([^ /]+[.]a) ([^ ]+) : ([a-z0-9]+) [Uw]" AND CMAKE_MATCH_3 IN_LIST names)
      list(APPEND found "${CMAKE_MATCH_1}: ${CMAKE_MATCH_2} calls ${CMAKE_MATCH_3}")
    endif()
  endforeach()
endforeach()
list(REMOVE_ITEM found ${calls_of_cgal})
if(found)
  list(JOIN found "\n  " found)
  message(FATAL_ERROR "Elementary functions of the system; call those of base/elementary.hpp:\n  ${found}")
endif()
