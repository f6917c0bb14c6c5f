// Exponentials, logarithms, powers and trigonometry that have the same bits on every processor. The C library
// chooses among several forms of each by what the processor can do (with FMA, with AVX2, with neither), and
// they round differently; another version of it may round differently again. A search that asks for one
// exponential then ends at another tree. The program and everything that links this room therefore have exp,
// log, pow, sin … of SLEEF instead (Shibata and Petrogalli 2020, "SLEEF: A Portable Vectorized Library of C
// Standard Mathematical Functions", IEEE TPDS 31(6)), in its forms without FMA, within 1.0 units in the last
// place (hypot .505, erfc 1.5).
//
// There is nothing to include for that: libm.cpp defines the C functions themselves, and a linker that finds
// one in an archive does not ask the C library for it. Since they are then names of the program, libraries
// that it is linked with, NLopt and LuaJIT, call them too.
#pragma once
#include <string>

namespace espalier {

/// As "3.5.1", of the headers that it was built with.
std::string sleef_version();

}  // namespace espalier
