#include "measured_vessel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "measured.h"
#include "vessel.h"

static const char rig_name[] = "measured/vessel.cfg";
static const char log_name[] = "vessel-air-charge-discharge/Air_790kPa_21mm.csv";

static const double source_diameter = 2.71e-3; /* [m] orifice in the source file */
static const double source_cd = 0.84;          /* [1] its discharge coefficient */

/* What is found out about one law. */
typedef struct finding {
  lab_fit_result fit;
  vessel_error p, T;        /* of the fit to all rows */
  vessel_error second_half; /* of pressure, fitted to the first half of the record */
  vessel_error left_out;    /* of pressure, each point predicted from the others */
} finding;

/* ---- Held-out rows ---- */

/* Middle of the pressure points: the last instant of the first half [s]. */
static double middle(const vessel *v)
{
  const double *p = v->log.value[LAB_CHANNEL_P];
  size_t i, n = 0, seen = 0;
  for (i = 0; i < v->log.n; i++)
    n += !isnan(p[i]);
  for (i = 0; seen < (n + 1) / 2; i++)
    seen += !isnan(p[i]);
  return v->log.value[LAB_CHANNEL_TIME][i - 1];
}

static int predict_second_half(const vessel *v, const vessel_law *law, unsigned char *use, vessel_error *out,
                               lab_error *error)
{
  const double split = middle(v);
  lab_fit_result fit;
  size_t i;
  for (i = 0; i < v->log.n; i++)
    use[i] = v->log.value[LAB_CHANNEL_TIME][i] <= split;
  if (vessel_fit(v, law, use, &fit, error))
    return error->status;
  return vessel_errors(v, law, fit.theta, LAB_CHANNEL_P, use, 0, out, error);
}

/* Each pressure point in turn.  Out: rmse and largest of the predictions */
static int leave_one_out(const vessel *v, const vessel_law *law, unsigned char *use, vessel_error *out,
                         lab_error *error)
{
  double squares = 0;
  size_t i;
  memset(out, 0, sizeof *out);
  memset(use, 1, v->log.n);
  for (i = 0; i < v->log.n; i++) {
    lab_fit_result fit;
    vessel_error one;
    if (isnan(v->log.value[LAB_CHANNEL_P][i]))
      continue;
    use[i] = 0;
    if (vessel_fit(v, law, use, &fit, error) || vessel_errors(v, law, fit.theta, LAB_CHANNEL_P, use, 0, &one, error))
      return error->status;
    use[i] = 1;
    squares += one.rmse * one.rmse;
    out->largest = fmax(out->largest, one.largest);
    out->n++;
  }
  out->rmse = sqrt(squares / (double)out->n);
  return LAB_OK;
}

static int find(const vessel *v, const vessel_law *law, unsigned char *use, finding *f, lab_error *error)
{
  if (vessel_fit(v, law, NULL, &f->fit, error) ||
      vessel_errors(v, law, f->fit.theta, LAB_CHANNEL_P, NULL, 1, &f->p, error) ||
      vessel_errors(v, law, f->fit.theta, LAB_CHANNEL_T, NULL, 1, &f->T, error) ||
      predict_second_half(v, law, use, &f->second_half, error) || leave_one_out(v, law, use, &f->left_out, error))
    return lab_fail_in(error, "law %s", law->name);
  return LAB_OK;
}

/* ---- One row a law, and one a parameter ---- */

static const char summary_header[] =
    "law,what,fitted_to,Ca [mm2],Ca_low [mm2],Ca_high [mm2],Cd_of_2.71_mm [1],diameter_at_Cd_0.84 [mm],"
    "rmse_p [kPa],max_p [kPa],rmse_p_left_out [kPa],rmse_p_second_half [kPa],lag1_p [1],rmse_T [K],max_T [K],n "
    "[1],remark";

static void add_summary(table *t, const vessel *v, const vessel_law *law, const finding *f)
{
  static const double quarter_pi = 0.78539816339744830962;
  const double area = f->fit.theta[0];
  table_row(t, "sssgggggggggggggs", law->name, law->what, law->with_T ? "p and T" : "p", 1e6 * area,
            1e6 * f->fit.low[0], 1e6 * f->fit.high[0], area / (quarter_pi * source_diameter * source_diameter),
            1e3 * sqrt(area / (source_cd * quarter_pi)), 1e-3 * f->p.rmse, 1e-3 * f->p.largest, 1e-3 * f->left_out.rmse,
            1e-3 * f->second_half.rmse, f->p.lag1, f->T.rmse, f->T.largest, vessel_exponent(v, law, f->fit.theta),
            f->fit.remark);
}

static const char parameter_header[] = "law,parameter,value,unit,ci95_low,ci95_high,state";

/* Every parameter of a law; at a bound there is no interval. */
static void add_parameters(table *t, const vessel_law *law, const lab_fit_result *fit)
{
  int j;
  for (j = 0; j < law->n; j++) {
    const double scale = vessel_item_scale(law->item[j]);
    const double known = fit->state[j] == LAB_FIT_FREE ? 1 : (double)NAN;
    table_row(t, "ssgsggs", law->name, vessel_item_key(law->item[j]), scale * fit->theta[j],
              vessel_item_unit(law->item[j]), known * scale * fit->low[j], known * scale * fit->high[j],
              lab_fit_state_text(fit->state[j]));
  }
}

/* ---- Curves ---- */

static const char curve_header[] = "law,t [s],p_data [kPa],p [kPa],p_residual [kPa],T_data [K],T [K],T_residual [K]";

enum { GRID = 224 };
static const double grid_end = 56; /* [s], every quarter of a second; the record ends at 54.8 s */

static int by_value(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The instants of the record and of an even grid, in order, each once.  Returns: their number. */
static size_t instants(const vessel *v, double *t)
{
  size_t i, n = v->log.n, kept = 1;
  memcpy(t, v->log.value[LAB_CHANNEL_TIME], n * sizeof *t);
  for (i = 0; i <= GRID; i++)
    t[n++] = grid_end * (double)i / GRID;
  qsort(t, n, sizeof *t, by_value);
  for (i = 1; i < n; i++)
    if (t[i] > t[kept - 1])
      t[kept++] = t[i];
  return kept;
}

static void add_rows(table *out, const vessel *v, const vessel_law *law, const double *t, size_t n, const double *p,
                     const double *T)
{
  const double ambient = (double)v->rig.params.ambient_pressure;
  size_t i, row = 0;
  for (i = 0; i < n; i++) {
    const int measured = row < v->log.n && v->log.value[LAB_CHANNEL_TIME][row] == t[i];
    const double p_data = measured ? v->log.value[LAB_CHANNEL_P][row] : (double)NAN;
    const double T_data = measured ? v->log.value[LAB_CHANNEL_T][row] : (double)NAN;
    table_row(out, "sggggggg", law->name, t[i], 1e-3 * (p_data + ambient), 1e-3 * (p[i] + ambient),
              1e-3 * (p_data - p[i]), T_data, T[i], T_data - T[i]);
    row += (size_t)measured;
  }
}

static int add_curve(table *out, const vessel *v, const vessel_law *law, const double *theta, lab_error *error)
{
  const size_t room = v->log.n + GRID + 1;
  double *t = calloc(3 * room, sizeof *t), *p, *T;
  size_t n;
  int status;
  if (!t)
    return lab_fail_memory(error, "curves of a vessel");
  p = t + room;
  T = p + room;
  n = instants(v, t);
  status = vessel_predict(v, law, theta, t, n, p, T, error);
  if (status == LAB_OK)
    add_rows(out, v, law, t, n, p, T);
  free(t);
  return status;
}

/* ---- All laws ---- */

typedef struct outputs {
  table summary, parameters, curves;
} outputs;

static int try_laws(const vessel *v, outputs *out, lab_error *error)
{
  unsigned char *use = malloc(v->log.n);
  int i, status = use ? LAB_OK : lab_fail_memory(error, "rows of a vessel");
  for (i = 0; i < vessel_law_count && status == LAB_OK; i++) {
    finding f;
    status = find(v, &vessel_laws[i], use, &f, error);
    if (status != LAB_OK)
      break;
    add_summary(&out->summary, v, &vessel_laws[i], &f);
    add_parameters(&out->parameters, &vessel_laws[i], &f.fit);
    status = add_curve(&out->curves, v, &vessel_laws[i], f.fit.theta, error);
  }
  free(use);
  return status;
}

static int save(const outputs *out, const char *results_dir, lab_error *error)
{
  if (measured_save(results_dir, "measured_vessel.csv", &out->summary, error) ||
      measured_save(results_dir, "measured_vessel_parameters.csv", &out->parameters, error))
    return error->status;
  return measured_save(results_dir, "measured_vessel_curves.csv", &out->curves, error);
}

static int compare(const vessel *v, const char *results_dir, lab_error *error)
{
  outputs out;
  int status;
  table_open(&out.summary, summary_header);
  table_open(&out.parameters, parameter_header);
  table_open(&out.curves, curve_header);
  status = try_laws(v, &out, error);
  if (status == LAB_OK)
    status = save(&out, results_dir, error);
  table_close(&out.summary);
  table_close(&out.parameters);
  table_close(&out.curves);
  return status;
}

int measured_vessel(const char *study_dir, const char *data_dir, const char *results_dir, lab_error *error)
{
  char path[1024], rig[1024];
  vessel v;
  int status = measured_path(data_dir, log_name, path, sizeof path, error);
  if (status == LAB_OK)
    status = measured_join(study_dir, rig_name, rig, sizeof rig, error);
  if (status != LAB_OK || (status = vessel_open(rig, path, &v, error)) != LAB_OK)
    return status;
  status = compare(&v, results_dir, error);
  vessel_close(&v);
  return status;
}
