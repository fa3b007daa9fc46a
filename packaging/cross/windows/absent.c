/* What the lab does by processes of its own, which Windows has not: batches and figures by gnuplot. */
#include "../../../apps/lab/base/gnuplot.h"
#include "../../../apps/lab/batch/batch.h"

int lab_batch_run(const lab_batch_options *options, lab_error *error)
{
  (void)options;
  return lab_fail(error, LAB_USAGE, "--batch: there is none on Windows yet; give one rig file and its logs at a time");
}

int lab_gnuplot_draw(const char *script, const char *in, const char *out, lab_error *error)
{
  (void)script;
  (void)in;
  return lab_fail(error, LAB_WORLD, "%s: this program draws no SVG on Windows; use --no-figures", out);
}

int lab_gnuplot_run(FILE *script, const char *out, int *drawn, lab_error *error)
{
  (void)script;
  (void)out;
  (void)error;
  *drawn = 0;
  return LAB_OK;
}
