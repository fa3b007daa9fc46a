#include "progress.h"

#include <math.h>
#include <unistd.h>

#include "clock.h"

void lab_progress_begin(lab_progress *progress, const char *what, int quiet)
{
  progress->stream = !quiet && isatty(STDERR_FILENO) ? stderr : NULL;
  progress->what = what;
  progress->start = progress->shown = lab_clock();
  progress->written = 0;
}

/* Whether it is time to write the line again. */
static int is_due(lab_progress *progress, double t)
{
  const double interval = 0.1;
  if (t - progress->shown < interval)
    return 0;
  progress->shown = t;
  progress->written = 1;
  return 1;
}

/* "45 s", "12 min", "3 h 20 min" */
static void duration(double s, char text[40])
{
  const double minutes = ceil(s / 60);
  if (s < 100)
    snprintf(text, 40, "%.0f s", s);
  else if (s < 6000)
    snprintf(text, 40, "%.0f min", minutes);
  else
    snprintf(text, 40, "%.0f h %.0f min", floor(minutes / 60), fmod(minutes, 60));
}

void lab_progress_count(lab_progress *progress, int done, int total, int before)
{
  const double t = lab_clock(), rate = (done - before) / (t - progress->start);
  char to_go[40];
  if (!progress->stream || !is_due(progress, t))
    return;
  fprintf(progress->stream, "\r%s: %d of %d", progress->what, done, total);
  if (rate > 0) {
    duration((total - done) / rate, to_go);
    fprintf(progress->stream, ", %.2g a second, %s to go", rate, to_go);
  }
  fputs(" \033[K", progress->stream);
  fflush(progress->stream);
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
