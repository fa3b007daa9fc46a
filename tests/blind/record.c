#include "record.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum kind { TEXT, COUNT, REAL };

#define COLUMN(name, kind, member)                                                                                     \
  {                                                                                                                    \
    name, kind, offsetof(blind_record, member), sizeof(((blind_record *)0)->member)                                    \
  }

static const struct column {
  const char *name;
  enum kind kind;
  size_t offset, size;
} columns[] = {
    COLUMN("trial", COUNT, trial),
    COLUMN("kind", TEXT, kind),
    COLUMN("channels", TEXT, channels),
    COLUMN("actuator", TEXT, actuator),
    COLUMN("gas", TEXT, gas),
    COLUMN("flow", TEXT, flow),
    COLUMN("pressure_noise [Pa]", REAL, pressure_noise),
    COLUMN("position_noise [m]", REAL, position_noise),
    COLUMN("effect", TEXT, effect[0]),
    COLUMN("size", REAL, size[0]),
    COLUMN("limit", REAL, limit[0]),
    COLUMN("unit", TEXT, unit[0]),
    COLUMN("second_effect", TEXT, effect[1]),
    COLUMN("second_size", REAL, size[1]),
    COLUMN("second_limit", REAL, limit[1]),
    COLUMN("second_unit", TEXT, unit[1]),
    COLUMN("size_over_limit [1]", REAL, ratio),
    COLUMN("verdict", TEXT, verdict),
    COLUMN("found", TEXT, found),
    COLUMN("indistinguishable_from", TEXT, alike),
    COLUMN("equation", TEXT, equation),
    COLUMN("significant_but_small", TEXT, small),
    COLUMN("error_before [1]", REAL, before),
    COLUMN("error_after [1]", REAL, after),
    COLUMN("holdout_before [1]", REAL, holdout_before),
    COLUMN("holdout_after [1]", REAL, holdout_after),
    COLUMN("own_statistic [1]", REAL, own_statistic),
    COLUMN("own_rank", COUNT, own_rank),
    COLUMN("detected", COUNT, detected),
    COLUMN("right_name", COUNT, name),
    COLUMN("right_or_stated", COUNT, stated),
    COLUMN("right_family", COUNT, family),
    COLUMN("why", TEXT, why),
    COLUMN("class", TEXT, class),
    COLUMN("log", TEXT, log),
    COLUMN("rate [1/s]", REAL, rate),
    COLUMN("rows", REAL, rows),
    COLUMN("imperfections", TEXT, imperfections),
    COLUMN("beyond", TEXT, beyond),
    COLUMN("begins", TEXT, begins),
    COLUMN("onset [s]", REAL, onset),
    COLUMN("second_size_over_limit [1]", REAL, second_ratio),
    COLUMN("condition", TEXT, condition),
    COLUMN("due", TEXT, due),
    COLUMN("deviations", TEXT, deviations),
    COLUMN("since", TEXT, since),
    COLUMN("n_due", COUNT, n_due),
    COLUMN("n_found", COUNT, n_found),
    COLUMN("n_said", COUNT, n_said),
    COLUMN("n_wrong", COUNT, n_wrong),
    COLUMN("far_due", COUNT, far_due),
    COLUMN("far_found", COUNT, far_found),
    COLUMN("onset_due", COUNT, onset_due),
    COLUMN("onset_said", COUNT, onset_said),
    COLUMN("onset_within", COUNT, onset_within),
    COLUMN("instrument", COUNT, instrument),
    COLUMN("cpu [s]", REAL, cpu),
};
enum {
  COLUMNS = sizeof columns / sizeof columns[0],
  RECORDED_COLUMNS = 24,
  CLEAN_COLUMNS = COLUMNS - RECORDED_COLUMNS
};

static int columns_of(int recorded)
{
  return recorded ? COLUMNS : CLEAN_COLUMNS;
}

void blind_record_header(FILE *file, int recorded)
{
  int i;
  for (i = 0; i < columns_of(recorded); i++)
    fprintf(file, "%s%s", i ? "," : "", columns[i].name);
  fputc('\n', file);
}

static void write_field(FILE *file, const struct column *c, const void *at)
{
  if (c->kind == TEXT)
    fputs(at, file);
  else if (c->kind == COUNT)
    fprintf(file, "%d", *(const int *)at);
  else if (isfinite(*(const double *)at))
    fprintf(file, "%.6g", *(const double *)at);
}

void blind_record_write(FILE *file, const blind_record *record, int recorded)
{
  int i;
  for (i = 0; i < columns_of(recorded); i++) {
    fputs(i ? "," : "", file);
    write_field(file, &columns[i], (const char *)record + columns[i].offset);
  }
  fputc('\n', file);
}

/* Returns: 0 if the field is not one of that kind. */
static int read_field(const struct column *c, const char *begin, size_t length, void *to)
{
  char text[BLIND_TEXT], *end = text;
  if (length >= sizeof text || (c->kind == TEXT && length >= c->size))
    return 0;
  memcpy(text, begin, length);
  text[length] = '\0';
  if (c->kind == TEXT)
    strcpy(to, text);
  else if (c->kind == COUNT)
    *(int *)to = (int)strtol(text, &end, 10);
  else
    *(double *)to = length ? strtod(text, &end) : (double)NAN;
  return c->kind == TEXT || *end == '\0';
}

int blind_record_read(const char *line, int recorded, blind_record *record)
{
  const int n = columns_of(recorded);
  int i;
  memset(record, 0, sizeof *record);
  for (i = 0; i < n; i++) {
    const size_t length = strcspn(line, ",\n");
    const char last = i + 1 < n ? ',' : '\n';
    if (line[length] != last || !read_field(&columns[i], line, length, (char *)record + columns[i].offset))
      return 0;
    line += length + 1;
  }
  return 1;
}
