#include "actuators.h"

#include "../base/names.h"

static const char fisher[] = "Fisher Bulletin 61.1:657, table 1 (largest travel), and 61.1:657 Size i (usual range)";
static const char fisher_large[] =
    "Fisher 657 sizes 80 and 100, instruction manual D100307X012, table 1 (largest travel)";
static const char masoneilan[] =
    "Masoneilan 37/38, instruction manual, GE Oil & Gas 2015, page 4 (largest stroke, usual "
    "range)";
static const char polna[] = "Polna, multi-spring actuators P/R, data sheet (the first of the ranges)";
static const char hora[] = "HORA PA-N 160 and PA-N 280, manual, table 1: stroke volume over stroke, total less stroke "
                           "volume";
static const char siemens[] = "Siemens Powers No. 4, technical instructions 155-032P25, specifications";

/* Of the ranges that a maker offers the first is taken; the plate of the actuator has the right one. */
static const lab_actuator actuators[] = {
    {"fisher-657-30", {"area=297 cm2", "stroke=19 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-34", {"area=445 cm2", "stroke=29 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-40", {"area=445 cm2", "stroke=38 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-45", {"area=677 cm2", "stroke=51 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-46", {"area=1006 cm2", "stroke=51 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-50", {"area=677 cm2", "stroke=51 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-60", {"area=1006 cm2", "stroke=51 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-70", {"area=1419 cm2", "stroke=76 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-80", {"area=1761 cm2", "stroke=76 mm"}, fisher_large},
    {"fisher-657-100", {"area=2902 cm2", "stroke=102 mm"}, fisher_large},
    {"masoneilan-37-9", {"area=45 in^2", "stroke=0.75 in", "bench_set=3..15 psi"}, masoneilan},
    {"masoneilan-37-11", {"area=71 in^2", "stroke=1 in", "bench_set=3..15 psi"}, masoneilan},
    {"masoneilan-37-13", {"area=105 in^2", "stroke=1.5 in", "bench_set=3..15 psi"}, masoneilan},
    {"masoneilan-37-15", {"area=145 in^2", "stroke=2 in", "bench_set=3..15 psi"}, masoneilan},
    {"masoneilan-37-18", {"area=200 in^2", "stroke=2.5 in", "bench_set=3..15 psi"}, masoneilan},
    {"polna-p-250", {"area=250 cm2", "stroke=20 mm", "bench_set=20..100 kPa"}, polna},
    {"polna-p-630-20", {"area=630 cm2", "stroke=20 mm", "bench_set=20..100 kPa"}, polna},
    {"polna-p-630-38", {"area=630 cm2", "stroke=38 mm", "bench_set=20..100 kPa"}, polna},
    {"polna-p-1000-38", {"area=1000 cm2", "stroke=38 mm", "bench_set=20..100 kPa"}, polna},
    {"polna-p-1000-63", {"area=1000 cm2", "stroke=63 mm", "bench_set=20..100 kPa"}, polna},
    {"hora-pa-n-160-10", {"area=160 cm2", "stroke=10 mm", "dead_volume=0.18 dm3"}, hora},
    {"hora-pa-n-160-20", {"area=160 cm2", "stroke=20 mm", "dead_volume=0.18 dm3"}, hora},
    {"hora-pa-n-280-20", {"area=280 cm2", "stroke=20 mm", "dead_volume=0.48 dm3"}, hora},
    {"hora-pa-n-280-30", {"area=280 cm2", "stroke=30 mm", "dead_volume=0.48 dm3"}, hora},
    {"siemens-powers-4", {"area=71 cm2", "stroke=102 mm", "bench_set=21..50 kPa"}, siemens},
};

const lab_actuator *lab_actuator_find(const char *name, lab_error *error)
{
  const size_t n = sizeof actuators / sizeof actuators[0];
  const int i = lab_name_index(name, actuators, n, sizeof actuators[0]);
  if (i >= 0)
    return &actuators[i];
  lab_fail(error, LAB_USAGE, "--sheet: unknown actuator \"%s\"; the nearest known one is \"%s\"", name,
           lab_name_nearest(name, actuators, n, sizeof actuators[0]));
  return NULL;
}
