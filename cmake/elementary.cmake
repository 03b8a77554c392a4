# SPDX-License-Identifier: GPL-3.0-or-later
# What base/elementary.hpp declares: the objects of musl's mathematical functions as Debian's musl-dev has them, in one
# object of ours. The functions are renamed, and all else in it is hidden, so that nothing of the system's own library
# is replaced. ridgecraft_elementary_object is that object, for the library that stands below all others.
if(EMSCRIPTEN)
  # Its own C library is musl, with the same sources of these functions.
  set(ridgecraft_elementary_object ${PROJECT_SOURCE_DIR}/wasm/elementary.c)
  return()
endif()
set(ridgecraft_elementary_functions sin cos tan asin acos atan2 pow exp exp2 log log2 log10 hypot)
# The members of the archive that these stand on.
set(ridgecraft_elementary_members ${ridgecraft_elementary_functions}
  atan fabs floor scalbn sqrt __cos __sin __tan __rem_pio2 __rem_pio2_large exp_data log_data log2_data pow_data
  __math_divzero __math_invalid __math_oflow __math_uflow __math_xflow)
list(TRANSFORM ridgecraft_elementary_members APPEND .lo)

string(REPLACE gnu musl ridgecraft_musl_folder "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}")
find_file(RIDGECRAFT_MUSL_LIBRARY libc.a PATHS ${ridgecraft_musl_folder} NO_DEFAULT_PATH
  DOC "musl's C library as an archive (Debian's package musl-dev)")
if(NOT RIDGECRAFT_MUSL_LIBRARY)
  message(FATAL_ERROR "There is no libc.a in ${ridgecraft_musl_folder}: install musl-dev, or set RIDGECRAFT_MUSL_LIBRARY")
endif()

set(ridgecraft_elementary_folder ${PROJECT_BINARY_DIR}/elementary)
set(ridgecraft_elementary_object ${ridgecraft_elementary_folder}/elementary.o)
set(ridgecraft_renamed "")
set(ridgecraft_kept "")
foreach(function IN LISTS ridgecraft_elementary_functions)
  list(APPEND ridgecraft_renamed --redefine-sym ${function}=ridgecraft_elementary_${function})
  list(APPEND ridgecraft_kept --keep-global-symbol ridgecraft_elementary_${function})
endforeach()
file(MAKE_DIRECTORY ${ridgecraft_elementary_folder})
add_custom_command(OUTPUT ${ridgecraft_elementary_object}
  COMMAND ${CMAKE_AR} x ${RIDGECRAFT_MUSL_LIBRARY} ${ridgecraft_elementary_members}
  COMMAND ${CMAKE_LINKER} -r -o together.o ${ridgecraft_elementary_members}
  # One after the other: in one step, LLVM's objcopy hides by the old names, GNU's by the new ones.
  COMMAND ${CMAKE_OBJCOPY} --strip-debug ${ridgecraft_renamed} together.o renamed.o
  COMMAND ${CMAKE_OBJCOPY} ${ridgecraft_kept} renamed.o ${ridgecraft_elementary_object}
  DEPENDS ${RIDGECRAFT_MUSL_LIBRARY}
  WORKING_DIRECTORY ${ridgecraft_elementary_folder}
  COMMENT "Taking elementary functions from musl"
  VERBATIM)
