# SPDX-License-Identifier: GPL-3.0-or-later
# qpdf with the cryptography of its own, without the part that is a program.
set(qpdf ${from}/qpdf)
file(CONFIGURE OUTPUT ${made}/qpdf/qpdf/qpdf-config.h @ONLY CONTENT [[
#define DEFAULT_CRYPTO "native"
#define USE_CRYPTO_NATIVE 1
#define HAVE_INTTYPES_H 1
#define HAVE_STDINT_H 1
#define HAVE_FSEEKO 1
#define HAVE_LOCALTIME_R 1
#define HAVE_RANDOM 1
#define HAVE_TM_GMTOFF 1
#define RANDOM_DEVICE "/dev/urandom"
#define SIZEOF_SIZE_T 4
]])
file(GLOB sources ${qpdf}/libqpdf/*.cc ${qpdf}/libqpdf/sha2*.c)
list(FILTER sources EXCLUDE REGEX
  "/(QPDFCrypto_(gnutls|openssl)|QPDFJob.*|QPDFArgParser|QPDFUsage|QPDFAcroForm.*|qpdf.*-c)\\.cc$")
ridgecraft_foreign_library(qpdf AS qpdf::libqpdf SOURCES ${sources} OFFERS ${qpdf}/include
  READS ${qpdf}/include ${qpdf}/libqpdf ${made}/qpdf DEFINES POINTERHOLDER_TRANSITION=4 LINKS JPEG::JPEG ZLIB::ZLIB)
# As a few units, in a sixth of the time: each file alone would read the same headers for seconds. These want to be alone.
set_target_properties(qpdf PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
ridgecraft_members(alone ${qpdf}/libqpdf BitWriter.cc QPDFWriter.cc QPDF_encryption.cc QPDF_optimization.cc)
set_source_files_properties(${alone} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
