# SPDX-License-Identifier: GPL-3.0-or-later
# libjpeg-turbo in plain C: what it unpacks is the same to the bit.
set(jpeg ${from}/libjpeg-turbo)
set(JPEG_LIB_VERSION 62)
set(VERSION 2.1.5)
set(LIBJPEG_TURBO_VERSION_NUMBER 2001005)
set(C_ARITH_CODING_SUPPORTED 1)
set(D_ARITH_CODING_SUPPORTED 1)
set(MEM_SRCDST_SUPPORTED 1)
set(BITS_IN_JSAMPLE 8)
set(BUILD Debian)
set(INLINE inline)
set(THREAD_LOCAL __thread)
set(SIZE_T 4)
set(HAVE_BUILTIN_CTZL 1)
set(COPYRIGHT_YEAR 1991-2023)
foreach(header IN ITEMS jconfig jconfigint jversion)
  configure_file(${jpeg}/${header}.h.in ${made}/jpeg/${header}.h)
endforeach()
ridgecraft_members(sources ${jpeg}
  jcapimin.c jcapistd.c jcarith.c jccoefct.c jccolor.c jcdctmgr.c jchuff.c jcicc.c jcinit.c jcmainct.c jcmarker.c
  jcmaster.c jcomapi.c jcparam.c jcphuff.c jcprepct.c jcsample.c jctrans.c jdapimin.c jdapistd.c jdarith.c jdatadst.c
  jdatasrc.c jdcoefct.c jdcolor.c jddctmgr.c jdhuff.c jdicc.c jdinput.c jdmainct.c jdmarker.c jdmaster.c jdmerge.c
  jdphuff.c jdpostct.c jdsample.c jdtrans.c jerror.c jfdctflt.c jfdctfst.c jfdctint.c jidctflt.c jidctfst.c jidctint.c
  jidctred.c jquant1.c jquant2.c jutils.c jmemmgr.c jmemnobs.c jaricom.c jsimd_none.c)
ridgecraft_foreign_library(jpeg AS JPEG::JPEG SOURCES ${sources} OFFERS ${made}/jpeg ${jpeg} READS ${made}/jpeg ${jpeg})
