// SPDX-License-Identifier: GPL-3.0-or-later
// What base/elementary.hpp declares, by musl's functions, which emscripten's C library has. A file of its
// own, and in C, so that the compiler doesn't see what is called: it would put in values that it has computed
// by other functions.
#include <math.h>

double ridgecraft_elementary_sin(double x) {
  return sin(x);
}
double ridgecraft_elementary_cos(double x) {
  return cos(x);
}
double ridgecraft_elementary_tan(double x) {
  return tan(x);
}
double ridgecraft_elementary_asin(double x) {
  return asin(x);
}
double ridgecraft_elementary_acos(double x) {
  return acos(x);
}
double ridgecraft_elementary_atan2(double y, double x) {
  return atan2(y, x);
}
double ridgecraft_elementary_pow(double base, double exponent) {
  return pow(base, exponent);
}
double ridgecraft_elementary_exp(double x) {
  return exp(x);
}
double ridgecraft_elementary_exp2(double x) {
  return exp2(x);
}
double ridgecraft_elementary_log(double x) {
  return log(x);
}
double ridgecraft_elementary_log2(double x) {
  return log2(x);
}
double ridgecraft_elementary_log10(double x) {
  return log10(x);
}
double ridgecraft_elementary_hypot(double x, double y) {
  return hypot(x, y);
}
