#include "progress.h"

#include <time.h>
#include <unistd.h>

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void lab_progress_begin(lab_progress *progress, const char *what, int quiet)
{
  progress->stream = !quiet && isatty(STDERR_FILENO) ? stderr : NULL;
  progress->what = what;
  progress->start = progress->shown = now();
  progress->written = 0;
}

void lab_progress_show(lab_progress *progress, double done, double total)
{
  const double interval = 0.1;
  double t, gone;
  if (!progress->stream || !(done > 0) || !(total >= done))
    return;
  t = now();
  if (t - progress->shown < interval)
    return;
  gone = t - progress->start;
  fprintf(progress->stream, "\r%s: %3.0f %%, %.1f s, %.1f s to go \033[K", progress->what, 100 * done / total, gone,
          gone * (total - done) / done);
  fflush(progress->stream);
  progress->shown = t;
  progress->written = 1;
}

void lab_progress_say(lab_progress *progress, const char *what)
{
  if (!progress->stream)
    return;
  fprintf(progress->stream, "\r%s: %s ... \033[K", progress->what, what);
  fflush(progress->stream);
  progress->written = 1;
}

void lab_progress_end(lab_progress *progress)
{
  if (progress->written)
    fputs("\r\033[K", progress->stream);
  progress->written = 0;
}
