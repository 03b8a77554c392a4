# SPDX-License-Identifier: GPL-3.0-or-later
# Cairo with pixman: pictures and PDF, without fonts of the system.
set(pixman ${from}/pixman/pixman)
file(CONFIGURE OUTPUT ${made}/pixman/pixman-config.h @ONLY CONTENT [[
#define HAVE_INTTYPES_H 1
#define HAVE_STDINT_H 1
#define HAVE_BUILTIN_CLZ 1
#define HAVE_POSIX_MEMALIGN 1
#define SIZEOF_LONG 4
#define TLS
#define PACKAGE "pixman"
]])
ridgecraft_members(sources ${pixman}
  pixman.c pixman-access.c pixman-access-accessors.c pixman-bits-image.c pixman-combine32.c pixman-combine-float.c
  pixman-conical-gradient.c pixman-filter.c pixman-x86.c pixman-mips.c pixman-arm.c pixman-ppc.c pixman-edge.c
  pixman-edge-accessors.c pixman-fast-path.c pixman-glyph.c pixman-general.c pixman-gradient-walker.c pixman-image.c
  pixman-implementation.c pixman-linear-gradient.c pixman-matrix.c pixman-noop.c pixman-radial-gradient.c
  pixman-region16.c pixman-region32.c pixman-solid-fill.c pixman-timer.c pixman-trap.c pixman-utils.c)
ridgecraft_foreign_library(pixman SOURCES ${sources} OFFERS ${pixman} READS ${pixman})
target_compile_options(pixman PRIVATE -include ${made}/pixman/pixman-config.h)

set(cairo ${from}/cairo/src)
file(CONFIGURE OUTPUT ${made}/cairo/cairo-features.h @ONLY CONTENT [[
#define CAIRO_FEATURES_H
#define CAIRO_HAS_IMAGE_SURFACE 1
#define CAIRO_HAS_MIME_SURFACE 1
#define CAIRO_HAS_OBSERVER_SURFACE 1
#define CAIRO_HAS_PDF_SURFACE 1
#define CAIRO_HAS_PNG_FUNCTIONS 1
#define CAIRO_HAS_RECORDING_SURFACE 1
#define CAIRO_HAS_USER_FONT 1
]])
file(CONFIGURE OUTPUT ${made}/cairo/config.h @ONLY CONTENT [[
#define CAIRO_HAS_PTHREAD 1
#define HAS_PIXMAN_GLYPHS 1
#define HAVE_CXX11_ATOMIC_PRIMITIVES 1
#define HAVE_CTIME_R 1
#define HAVE_FCNTL_H 1
#define HAVE_GMTIME_R 1
#define HAVE_INTTYPES_H 1
#define HAVE_LOCALTIME_R 1
#define HAVE_STDINT_H 1
#define HAVE_STDLIB_H 1
#define HAVE_STRINGS_H 1
#define HAVE_STRING_H 1
#define HAVE_STRNDUP 1
#define HAVE_SYS_STAT_H 1
#define HAVE_SYS_TYPES_H 1
#define HAVE_TIME_H 1
#define HAVE_UINT64_T 1
#define HAVE_UNISTD_H 1
#define HAVE_ZLIB 1
#define PACKAGE_NAME "cairo"
#define SIZEOF_INT 4
#define SIZEOF_LONG 4
#define SIZEOF_LONG_LONG 8
#define SIZEOF_SIZE_T 4
#define SIZEOF_VOID_P 4
]])
# All of the library but what speaks to other systems.
file(GLOB sources ${cairo}/cairo*.c)
list(FILTER sources EXCLUDE REGEX
  "/cairo-(beos|boilerplate|cogl|directfb|drm|egl|ft|gl|glx|os2|ps|qt|quartz|script|skia|svg|tee|vg|wgl|win32|xcb|xlib|xml)[-.]")
ridgecraft_foreign_library(cairo AS PkgConfig::cairo SOURCES ${sources} OFFERS ${made}/cairo ${cairo}
  READS ${made}/cairo ${cairo} DEFINES HAVE_CONFIG_H LINKS pixman PNG::PNG ZLIB::ZLIB)
