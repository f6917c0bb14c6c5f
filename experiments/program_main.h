// How the programs of this folder end: what fails is one line on stderr.
#pragma once
#include <fmt/core.h>

#include <cstdio>
#include <exception>

#include <espalier/core/error.h>

namespace espalier {

/// The exit code of `run`; 2 where input is bad, 1 where we fail.
inline int run_program(int argc, char** argv, int (*run)(int argc, char** argv)) {
  try {
    return run(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 1;
  }
}

}  // namespace espalier
