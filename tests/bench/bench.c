#include "bench.h"

#include <stdio.h>
#include <string.h>

#include <omp.h>

#include "../../apps/lab/base/outfile.h"

int bench_repeats(const bench *b, int usual)
{
  return b->quick ? BENCH_FEWEST : usual;
}

void bench_item(bench *b, const char *item, const char *law, const char *who, double tol, double error,
                const bench_spread *time, double own)
{
  table_row(&b->items, "sssggggggg", item, law, who, tol, error, (double)time->n, time->low, time->median, time->high,
            time->median / own);
  fprintf(stderr, "%-28s %-18s %-10s error %-8.1e %10.4g ms  ratio %.3g\n", item, law, who, error, time->median * 1e3,
          time->median / own);
}

void bench_scale(bench *b, const char *task, const char *grows, double value, const bench_spread *time)
{
  table_row(&b->scaling, "ssggggg", task, grows, value, (double)time->n, time->low, time->median, time->high);
  fprintf(stderr, "%-12s %-10s %8g  %10.4g ms\n", task, grows, value, time->median * 1e3);
}

static int save(const bench *b, const char *name, const table *t, lab_error *error)
{
  char path[BENCH_PATH];
  lab_outfile out;
  snprintf(path, sizeof path, "%s/%s", b->results, name);
  if (lab_out_open(&out, path, error))
    return error->status;
  return lab_out_end(&out, table_write(t, out.file, error), error);
}

static int all_parts(bench *b, lab_error *error)
{
  if (lab_make_folder(b->scratch, error) || bench_races(b, error) || bench_small(b, error) || bench_fits(b, error) ||
      bench_loops(b, error) || bench_readings(b, error) || bench_growth(b, error))
    return error->status;
  if (save(b, "bench.csv", &b->items, error) || save(b, "work_precision.csv", &b->diagram, error))
    return error->status;
  return save(b, "scaling.csv", &b->scaling, error);
}

int bench_run(const char *results, const char *scratch, const char *programs, int quick, const bench_contender *rival,
              int n_rivals)
{
  static bench b;
  bench_contender all[BENCH_CONTENDERS_MAX];
  lab_error error;
  int status;
  memcpy(all, bench_own, sizeof bench_own);
  if (n_rivals > BENCH_CONTENDERS_MAX - BENCH_OWN)
    n_rivals = BENCH_CONTENDERS_MAX - BENCH_OWN;
  if (n_rivals > 0)
    memcpy(all + BENCH_OWN, rival, (size_t)n_rivals * sizeof *rival);
  b.results = results;
  b.scratch = scratch;
  b.programs = programs;
  b.quick = quick;
  b.contender = all;
  b.n = BENCH_OWN + n_rivals;
  table_open(&b.items, "item,law,contender,tolerance,error [1],repeats,low [s],median [s],high [s],ratio");
  table_open(&b.diagram, "integrator,gas,flow,tol,error,time_us");
  table_open(&b.scaling, "task,grows,value,repeats,low [s],median [s],high [s]");
  omp_set_num_threads(1);
  status = all_parts(&b, &error);
  if (status != LAB_OK)
    fprintf(stderr, "bench: %s\n", error.text);
  table_close(&b.items);
  table_close(&b.diagram);
  table_close(&b.scaling);
  return status;
}
