// SPDX-License-Identifier: BSD-3-Clause
/// Runs the benchmarks of a program. Exit codes: 0 all ran, 1 one of them does not do what it is
/// timed for, 2 wrong usage.
#include <exception>
#include <iostream>

#include <benchmark/benchmark.h>

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << "\n";
    return 1;
  }
  return 0;
}
