/* SI units as FMI wants them: exponents of base units.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_UNITS_H
#define FMU_UNITS_H

enum fmu_base { FMU_BASE_KG, FMU_BASE_M, FMU_BASE_S, FMU_BASE_K, FMU_BASE_COUNT };

/* Their names, as attributes of BaseUnit. */
extern const char *const fmu_base_names[FMU_BASE_COUNT];

/* Exponents of a unit such as "N.s/m", "kg/s" or "1".
 * Returns: 0 where it has none in whole numbers, or a symbol that is not known. */
int fmu_unit_exponents(const char *unit, int exponent[FMU_BASE_COUNT]);

#endif
