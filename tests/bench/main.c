/* The benchmark without rivals but CVODE; tests/bench/rivals.py is the one with them.
 *
 * Usage: bench RESULTS SCRATCH PROGRAMS [quick]
 * SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "bench.h"

int main(int argc, char **argv)
{
  if (argc < 4) {
    fprintf(stderr, "usage: bench RESULTS SCRATCH PROGRAMS [quick]\n");
    return LAB_USAGE;
  }
  return bench_run(argv[1], argv[2], argv[3], argc > 4, NULL, 0);
}
