# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DFROM=FOLDER -DTO=FOLDER -DHEADERS=a/b.hpp,c.hpp -P copy_headers.cmake: copies of headers that include each
# other as <ridgecraft/...>. What hasn't changed keeps its time.
string(REPLACE "," ";" HEADERS "${HEADERS}")
foreach(header IN LISTS HEADERS)
  file(READ ${FROM}/${header} text)
  string(REGEX REPLACE "#include \"([^\"]+)\"" "#include <ridgecraft/\\1>" text "${text}")
  set(there "")
  if(EXISTS ${TO}/${header})
    file(READ ${TO}/${header} there)
  endif()
  if(NOT "${text}" STREQUAL "${there}")
    file(WRITE ${TO}/${header} "${text}")
  endif()
endforeach()
