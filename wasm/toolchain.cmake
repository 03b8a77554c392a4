# SPDX-License-Identifier: GPL-3.0-or-later
# Debian's emscripten, with what all objects must agree on.
set(EMSCRIPTEN_ROOT_PATH /usr/share/emscripten)
include(${EMSCRIPTEN_ROOT_PATH}/cmake/Modules/Platform/Emscripten.cmake)
# Exceptions of WebAssembly itself, and long jumps by the same means: those that are made of JavaScript take several
# times as long.
set(CMAKE_C_FLAGS_INIT "-fwasm-exceptions -sSUPPORT_LONGJMP=wasm")
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -sSUPPORT_LONGJMP=wasm")
# -O3 makes the file a quarter larger and nothing faster.
set(CMAKE_C_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "")
