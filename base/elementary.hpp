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
double ridgecraft_elementary_exp(double x);
double ridgecraft_elementary_exp2(double x);
double ridgecraft_elementary_log(double x);
double ridgecraft_elementary_log2(double x);
double ridgecraft_elementary_log10(double x);
double ridgecraft_elementary_hypot(double x, double y);
}

namespace ridgecraft::elementary {

inline constexpr auto& sin = ridgecraft_elementary_sin;
inline constexpr auto& cos = ridgecraft_elementary_cos;
inline constexpr auto& tan = ridgecraft_elementary_tan;
inline constexpr auto& asin = ridgecraft_elementary_asin;
inline constexpr auto& acos = ridgecraft_elementary_acos;
inline constexpr auto& atan2 = ridgecraft_elementary_atan2;
inline constexpr auto& pow = ridgecraft_elementary_pow;
inline constexpr auto& exp = ridgecraft_elementary_exp;
inline constexpr auto& exp2 = ridgecraft_elementary_exp2;
inline constexpr auto& log = ridgecraft_elementary_log;
inline constexpr auto& log2 = ridgecraft_elementary_log2;
inline constexpr auto& log10 = ridgecraft_elementary_log10;
inline constexpr auto& hypot = ridgecraft_elementary_hypot;

}  // namespace ridgecraft::elementary
