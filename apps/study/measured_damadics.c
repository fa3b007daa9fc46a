#include "measured_damadics.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "measured.h"
#include "servomotor.h"

static const char rig_name[] = "measured/damadics.cfg";
static const char loop_name[] = "damadics-servomotor-static-step/static_hysteresis_fig5.csv";

/* The law that is kept: the lowest error among those whose terms have a size that packing and spring can have. */
static const char kept_law[] = "friction-position+hardening";

/* Bench set of the figures [Pa]: what shares of the span are taken of. */
static const double bench_span = 80e3;

/* Errors in pressure of a law. */
typedef struct finding {
  lab_fit_result fit;
  double rmse, largest, lag1; /* [Pa], [Pa], [1] */
  double held_out;            /* [Pa] rms: odd points predicted from the even ones, and the reverse */
  double bic;                 /* Bayes information criterion; only differences mean something */
} finding;

/* ---- Errors ---- */

/* Sum of squared errors over the sliding points whose `use` is `wanted`.  Out: their number */
static int squares(const servomotor *s, const servo_law *law, const double *theta, const unsigned char *use, int wanted,
                   double *sum, size_t *n, lab_error *error)
{
  size_t i;
  for (i = 0; i < s->n; i++) {
    double p;
    if (!s->sliding[i] || use[i] != wanted)
      continue;
    if (servo_pressure(s, law, theta, s->x[i], s->direction[i], &p, error))
      return error->status;
    *sum += (p - s->p[i]) * (p - s->p[i]);
    ++*n;
  }
  return LAB_OK;
}

/* Every other sliding point, from `first` on. */
static void mark_alternate(const servomotor *s, int first, unsigned char *use)
{
  size_t i;
  int k = first;
  for (i = 0; i < s->n; i++) {
    use[i] = (unsigned char)(s->sliding[i] && k % 2 == 0);
    k += s->sliding[i];
  }
}

static int predict_alternate(const servomotor *s, const servo_law *law, double *held_out, lab_error *error)
{
  unsigned char use[SERVO_POINTS];
  double sum = 0;
  size_t n = 0;
  int first;
  for (first = 0; first < 2; first++) {
    lab_fit_result fit;
    mark_alternate(s, first, use);
    if (servo_fit(s, law, use, &fit, error) || squares(s, law, fit.theta, use, 0, &sum, &n, error))
      return error->status;
  }
  *held_out = sqrt(sum / (double)n);
  return LAB_OK;
}

/* Errors of the fit point by point. */
static int sum_errors(const servomotor *s, const servo_law *law, finding *f, lab_error *error)
{
  double sum = 0, products = 0, before = 0, p;
  size_t i, n = 0;
  for (i = 0; i < s->n; i++) {
    double e;
    if (!s->sliding[i])
      continue;
    if (servo_pressure(s, law, f->fit.theta, s->x[i], s->direction[i], &p, error))
      return error->status;
    e = p - s->p[i];
    sum += e * e;
    products += e * before;
    before = e;
    f->largest = fmax(f->largest, fabs(e));
    n++;
  }
  f->rmse = sqrt(sum / (double)n);
  f->lag1 = products / sum;
  f->bic = (double)n * log(sum / (double)n) + f->fit.n * log((double)n);
  return LAB_OK;
}

static int find(const servomotor *s, const servo_law *law, finding *f, lab_error *error)
{
  memset(f, 0, sizeof *f);
  if (servo_fit(s, law, NULL, &f->fit, error) || sum_errors(s, law, f, error) ||
      predict_alternate(s, law, &f->held_out, error))
    return lab_fail_in(error, "law %s", law->name);
  return LAB_OK;
}

/* ---- One row a law ---- */

static const char static_header[] =
    "law,parameters,bench_low [kPa],bench_low_ci95 [kPa],span [kPa],span_ci95 [kPa],friction [kPa],"
    "friction_ci95 [kPa],added_terms,rmse [kPa],max [kPa],lag1 [1],rmse_held_out [kPa],bic,remark";

/* Half width of an interval, in the unit of reports. */
static double half_width(const servo_law *law, const lab_fit_result *fit, int j)
{
  return servo_scale(law, j) * (fit->high[j] - fit->low[j]) / 2;
}

/* "friction_position 1.40 +- 0.33 kPa; ..." */
static void write_terms(const servo_law *law, const lab_fit_result *fit, char *text, size_t size)
{
  size_t used = 0;
  int j;
  text[0] = '\0';
  for (j = SERVO_BASE_COUNT; j < fit->n && used < size; j++)
    used += (size_t)snprintf(text + used, size - used, "%s%s %.3g +- %.2g %s", used ? "; " : "", servo_key(law, j),
                             servo_scale(law, j) * fit->theta[j], half_width(law, fit, j), servo_unit(law, j));
}

static void add_law(table *t, const servo_law *law, const finding *f)
{
  char added[256];
  write_terms(law, &f->fit, added, sizeof added);
  table_row(t, "sgggggggsgggggs", law->name, (double)f->fit.n, 1e-3 * f->fit.theta[SERVO_BENCH_LOW],
            half_width(law, &f->fit, SERVO_BENCH_LOW), 1e-3 * f->fit.theta[SERVO_SPAN],
            half_width(law, &f->fit, SERVO_SPAN), 1e-3 * f->fit.theta[SERVO_FRICTION],
            half_width(law, &f->fit, SERVO_FRICTION), added, 1e-3 * f->rmse, 1e-3 * f->largest, f->lag1,
            1e-3 * f->held_out, f->bic, f->fit.remark);
}

/* ---- Points and ramps ---- */

static const char loop_header[] = "law,kind,direction [1],p [kPa],x [%],sliding [1],p_model [kPa],residual [kPa]";

enum { RAMP = 231 };
static const double ramp_top = 115e3; /* [Pa]: the loop's last points, every 0.5 kPa */

/* Points with the pressure of the model at their position; on a stop there is none. */
static int add_points(table *t, const servomotor *s, const servo_law *law, const double *theta, lab_error *error)
{
  size_t i;
  for (i = 0; i < s->n; i++) {
    double p = (double)NAN;
    if (s->sliding[i] && servo_pressure(s, law, theta, s->x[i], s->direction[i], &p, error))
      return error->status;
    table_row(t, "ssgggggg", law->name, "point", (double)s->direction[i], 1e-3 * s->p[i], 100 * s->x[i] / s->nominal,
              (double)s->sliding[i], 1e-3 * p, 1e-3 * (s->p[i] - p));
  }
  return LAB_OK;
}

static int add_ramp(table *t, const servomotor *s, const servo_law *law, const double *theta, lab_error *error)
{
  double p[2 * RAMP], x[2 * RAMP];
  size_t i;
  if (servo_ramp(s, law, theta, ramp_top, RAMP, p, x, error))
    return error->status;
  for (i = 0; i < (size_t)2 * RAMP; i++)
    table_row(t, "ssgggggg", law->name, "ramp", i < RAMP ? 1.0 : -1.0, 1e-3 * p[i], 100 * x[i] / s->nominal,
              (double)NAN, (double)NAN, (double)NAN);
  return LAB_OK;
}

/* ---- Catalogue ---- */

/* Pressure of the falling branch at x, linear between its points; NaN outside of the sliding ones. */
static double falling_pressure(const servomotor *s, double x)
{
  size_t i;
  for (i = 0; i + 1 < s->n; i++)
    if (s->direction[i] < 0 && s->sliding[i] && s->sliding[i + 1] && s->x[i] <= x && x <= s->x[i + 1])
      return s->p[i] + (s->p[i + 1] - s->p[i]) * (x - s->x[i]) / (s->x[i + 1] - s->x[i]);
  return (double)NAN;
}

/* Width and mid-line of the loop at the sliding points of the rising branch. */
typedef struct shape {
  size_t n;
  double x[SERVO_POINTS], width[SERVO_POINTS], middle[SERVO_POINTS];
} shape;

static void measure_shape(const servomotor *s, shape *out)
{
  size_t i;
  out->n = 0;
  for (i = 0; i < s->n; i++) {
    const double falling = s->direction[i] > 0 && s->sliding[i] ? falling_pressure(s, s->x[i]) : (double)NAN;
    if (isnan(falling))
      continue;
    out->x[out->n] = s->x[i];
    out->width[out->n] = s->p[i] - falling;
    out->middle[out->n++] = 0.5 * (s->p[i] + falling);
  }
}

/* The same of a law, at the same positions. */
static int model_shape(const servomotor *s, const servo_law *law, const double *theta, shape *out, lab_error *error)
{
  size_t i;
  for (i = 0; i < out->n; i++) {
    double up, down;
    if (servo_pressure(s, law, theta, out->x[i], 1, &up, error) ||
        servo_pressure(s, law, theta, out->x[i], -1, &down, error))
      return error->status;
    out->width[i] = up - down;
    out->middle[i] = 0.5 * (up + down);
  }
  return LAB_OK;
}

/* Largest distance of the mid-line from its least-squares straight line. */
static double bow(const shape *s)
{
  double sx = 0, sy = 0, sxx = 0, sxy = 0, slope, offset, largest = 0;
  const double n = (double)s->n;
  size_t i;
  for (i = 0; i < s->n; i++) {
    sx += s->x[i];
    sy += s->middle[i];
    sxx += s->x[i] * s->x[i];
    sxy += s->x[i] * s->middle[i];
  }
  slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  offset = (sy - slope * sx) / n;
  for (i = 0; i < s->n; i++)
    largest = fmax(largest, fabs(s->middle[i] - offset - slope * s->x[i]));
  return largest;
}

static double mean(const double *value, size_t n)
{
  double sum = 0;
  size_t i;
  for (i = 0; i < n; i++)
    sum += value[i];
  return sum / (double)n;
}

static double greatest(const double *value, size_t n)
{
  double most = 0;
  size_t i;
  for (i = 0; i < n; i++)
    most = fmax(most, value[i]);
  return most;
}

/* Pressure midway between rising and falling at a position, by the law. */
static double mid_pressure(const servomotor *s, const servo_law *law, const double *theta, double x)
{
  double up = (double)NAN, down = (double)NAN;
  lab_error ignored;
  servo_pressure(s, law, theta, x, 1, &up, &ignored);
  servo_pressure(s, law, theta, x, -1, &down, &ignored);
  return 0.5 * (up + down);
}

/* Hysteresis, linearity and bench set, measured and modelled, beside what the specification says. */
static int add_catalogue(table *t, const servomotor *s, const servo_law *law, const double *theta, lab_error *error)
{
  const double percent = 100 / bench_span;
  shape data, model;
  measure_shape(s, &data);
  model = data;
  if (model_shape(s, law, theta, &model, error))
    return error->status;
  table_row(t, "ssggss", "hysteresis, mean width", "% of span", percent * mean(data.width, data.n),
            percent * mean(model.width, model.n), "4", "catalogue +-2; text of the source: about 10, from packing");
  table_row(t, "ssggss", "hysteresis, greatest width", "% of span", percent * greatest(data.width, data.n),
            percent * greatest(model.width, model.n), "4", "at the upper end of the travel");
  table_row(t, "ssggss", "linearity, greatest distance of the mid-line from a straight line", "% of span",
            percent * bow(&data), percent * bow(&model), "4", "catalogue +-4");
  table_row(t, "ssggss", "pressure at 0 % of travel, friction taken off", "kPa", (double)NAN,
            1e-3 * mid_pressure(s, law, theta, 0), "20", "bench set");
  table_row(t, "ssggss", "pressure at 100 % of travel, friction taken off", "kPa", (double)NAN,
            1e-3 * mid_pressure(s, law, theta, s->nominal), "100", "bench set");
  return LAB_OK;
}

/* ---- All laws ---- */

typedef struct outputs {
  table laws, loop, catalogue;
} outputs;

static int try_laws(const servomotor *s, outputs *out, lab_error *error)
{
  int i;
  for (i = 0; i < servo_law_count; i++) {
    const servo_law *law = &servo_laws[i];
    finding f;
    if (find(s, law, &f, error))
      return error->status;
    add_law(&out->laws, law, &f);
    if (add_points(&out->loop, s, law, f.fit.theta, error) || add_ramp(&out->loop, s, law, f.fit.theta, error))
      return error->status;
    if (!strcmp(law->name, kept_law) && add_catalogue(&out->catalogue, s, law, f.fit.theta, error))
      return error->status;
  }
  return LAB_OK;
}

static int save(const outputs *out, const char *results_dir, lab_error *error)
{
  if (measured_save(results_dir, "measured_damadics_static.csv", &out->laws, error) ||
      measured_save(results_dir, "measured_damadics_loop.csv", &out->loop, error))
    return error->status;
  return measured_save(results_dir, "measured_damadics_catalogue.csv", &out->catalogue, error);
}

static int compare_loop(const char *rig_path, const char *loop_path, const char *results_dir, lab_error *error)
{
  servomotor s;
  outputs out;
  int status = servo_read(rig_path, loop_path, &s, error);
  if (status != LAB_OK)
    return status;
  table_open(&out.laws, static_header);
  table_open(&out.loop, loop_header);
  table_open(&out.catalogue, "quantity,unit,measured,model,source,note");
  status = try_laws(&s, &out, error);
  if (status == LAB_OK)
    status = save(&out, results_dir, error);
  table_close(&out.laws);
  table_close(&out.loop);
  table_close(&out.catalogue);
  return status;
}

int measured_damadics(const char *study_dir, const char *data_dir, const char *results_dir, lab_error *error)
{
  char path[1024], rig[1024];
  int status = measured_path(data_dir, loop_name, path, sizeof path, error);
  if (status == LAB_OK)
    status = measured_join(study_dir, rig_name, rig, sizeof rig, error);
  if (status == LAB_OK)
    status = compare_loop(rig, path, results_dir, error);
  return status == LAB_OK ? measured_damadics_steps(study_dir, data_dir, results_dir, error) : status;
}
