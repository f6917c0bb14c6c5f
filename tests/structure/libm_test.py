#!/usr/bin/env python3
"""The program asks the C library for no function whose last bit depends on the processor (src/libm/libm.h).

    python3 -B tests/structure/libm_test.py PROGRAM

Functions that have one right result on every machine, such as floor and fmod, may be asked for; so may those of long
double, of which the C library for x86-64 has one form. nm comes with the compiler."""

import re
import subprocess
import sys

ROUNDED_OTHERWISE = ("exp exp2 exp10 expm1 log log2 log10 log1p pow cbrt hypot sin cos tan asin acos atan atan2 sincos "
                     "sinh cosh tanh asinh acosh atanh erf erfc lgamma lgamma_r tgamma fma j0 j1 jn y0 y1 yn").split()


def asked_of_libraries(program):
    lines = subprocess.run(["nm", "-D", "--undefined-only", program], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r" U (\w+)", lines))


def main():
    asked = asked_of_libraries(sys.argv[1])
    if "malloc" not in asked and "free" not in asked:
        print(f"{sys.argv[1]}: nm shows no function of the C library; this check looks at nothing")
        return 1
    wrong = [name for name in asked if name in ROUNDED_OTHERWISE or name.removesuffix("f") in ROUNDED_OTHERWISE]
    for name in sorted(wrong):
        print(f"{sys.argv[1]}: asks the C library for {name}, expected one of src/libm, with the same bits everywhere")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
