// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary functions with the same last bit on every machine. Those of <cmath> are the system's: glibc has
// several versions of each and takes one by what the processor can do, so that a net may look otherwise on
// the neighbour's computer. These are musl's, whatever else the program is linked with
// (cmake/elementary.cmake); their errors stay below two units in the last place. Compilers don't know them,
// and so don't put values of their own in their place.
//
// The square root and what only rounds or takes numbers apart (std::sqrt, floor, round, fmod, ldexp,
// nextafter) are exact everywhere and stay in <cmath>. A test holds that our libraries call no others.
#pragma once

extern "C" {
double ridgecraft_elementary_sin(double x);
double ridgecraft_elementary_cos(double x);
double ridgecraft_elementary_tan(double x);
double ridgecraft_elementary_asin(double x);
double ridgecraft_elementary_acos(double x);
double ridgecraft_elementary_atan2(double y, double x);
double ridgecraft_elementary_pow(double base, double exponent);
double ridgecraft_elementary_exp2(double x);
double ridgecraft_elementary_log(double x);
double ridgecraft_elementary_log2(double x);
double ridgecraft_elementary_log10(double x);
double ridgecraft_elementary_hypot(double x, double y);
}

namespace ridgecraft::elementary {

inline double sin(double x) {
  return ridgecraft_elementary_sin(x);
}
inline double cos(double x) {
  return ridgecraft_elementary_cos(x);
}
inline double tan(double x) {
  return ridgecraft_elementary_tan(x);
}
inline double asin(double x) {
  return ridgecraft_elementary_asin(x);
}
inline double acos(double x) {
  return ridgecraft_elementary_acos(x);
}
inline double atan2(double y, double x) {
  return ridgecraft_elementary_atan2(y, x);
}
inline double pow(double base, double exponent) {
  return ridgecraft_elementary_pow(base, exponent);
}
inline double exp2(double x) {
  return ridgecraft_elementary_exp2(x);
}
inline double log(double x) {
  return ridgecraft_elementary_log(x);
}
inline double log2(double x) {
  return ridgecraft_elementary_log2(x);
}
inline double log10(double x) {
  return ridgecraft_elementary_log10(x);
}
inline double hypot(double x, double y) {
  return ridgecraft_elementary_hypot(x, y);
}

}  // namespace ridgecraft::elementary
