/* Logs as people's recorders write them: what clock, converters and mains do to a log is recognised, and changes no
 * verdict. The rig is that of tests/second, which shares nothing with the library. */
#include "../../fixture.h"
#include "../../scratch.h"

#include "../../../apps/lab/report/answer.h"
#include "../../second/rig.h"

enum { FINE = 52001 };
static const double fine = 5e-4, t_end = 26, noise_p = 350, noise_x = 2.5e-5;

static struct {
  double t[FINE], u[FINE], p[FINE], x[FINE];
} truth;

static second_rig rig;
static uint64_t seed;

/* How a log is recorded. */
typedef struct recorder {
  const char *name;
  double spacing;          /* [s] */
  double jitter, rounding; /* [s] of the times: deviation; step */
  int stamped;             /* the jitter is in the stamps; else in the rows */
  int bits;                /* of the converters; 0: fine ones */
  double quiet;            /* times the usual noise */
  double memory;           /* of the noise from row to row */
  double hum;              /* amplitude over noise, 50 Hz */
  double declared;         /* noise over what it is */
  int cuts;                /* rounds down, and takes some times that are on a step for one just before it */
  double wander;           /* amplitude over noise of what has a memory of 40 rows, on top of it */
} recorder;

static const recorder as_declared = {"as declared", 0.007, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0};
static const recorder rounded = {"time rounded to 10 ms", 0.012, 0, 0.01, 0, 0, 1, 0, 0, 1, 0, 0};
static const recorder late = {"rows at uncertain times", 0.007, 0.003, 0, 0, 0, 1, 0, 0, 1, 0, 0};
static const recorder stamped = {"stamps that jitter", 0.007, 0.003, 0, 1, 0, 1, 0, 0, 1, 0, 0};
static const recorder ten_bits = {"10 bits, noise of a step", 0.007, 0, 0, 0, 10, 1, 0, 0, 1, 0, 0};
static const recorder plain_steps = {"10 bits, hardly any noise", 0.007, 0, 0, 0, 10, 0.2, 0, 0, 1, 0, 0};
static const recorder humming = {"hum of three times the noise", 0.005, 0, 0, 0, 0, 1, 0, 3, 1, 0, 0};
static const recorder coloured = {"coloured noise", 0.007, 0, 0, 0, 0, 1, 0.7, 0, 1, 0, 0};
static const recorder noisier = {"a third of the noise declared", 0.007, 0, 0, 0, 0, 1, 0, 0, 1. / 3, 0, 0};
static const recorder quieter = {"three times the noise declared", 0.007, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0};
static const recorder cut = {"time cut to 20 ms", 0.05, 0, 0.02, 0, 0, 1, 0, 0, 1, 1, 0};

static const recorder wandering = {"noise with a long memory", 0.007, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0.7};
static const recorder controller = {"commands at its rows, ten a second", 0.1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0};

/* ---- Recording ---- */

static double stamp(const recorder *r, int k, double t)
{
  if (!(r->rounding > 0))
    return t;
  if (r->cuts)
    return fmax(r->rounding * (floor(t / r->rounding + 1e-9) - (k % 14 == 10)), 0);
  return r->rounding * nearbyint(t / r->rounding);
}

static double at(const double *value, double t)
{
  const int i = (int)fmin(fmax(t / fine, 0), FINE - 2);
  return value[i] + (value[i + 1] - value[i]) * fmin(fmax(t / fine - i, 0), 1);
}

static double converted(double value, double span, int bits)
{
  const double step = 1.25 * span / (1 << (bits ? bits : 16));
  return step * nearbyint(value / step);
}

static void run_truth(double leak)
{
  static const double t_cmd[] = {0.9, 6.1, 7.7, 9.6, 10.9, 17.2, 19.1, 21.3},
                      u_cmd[] = {0.9, -0.8, 0, 0.6, 0, 1, -0.5, -1};
  const second_log log = {.t = truth.t, .u = truth.u, .p = truth.p, .x = truth.x};
  rig = second_rig_default_r1_400();
  rig.flow = SECOND_CHOKED;
  rig.dead_volume = 1e-4;
  rig.dry_friction = 420;
  rig.leak_area = leak * rig.fill_area;
  assert_int_equal(second_samples(t_end, fine), FINE);
  assert_int_equal(second_run(&rig, t_cmd, u_cmd, COUNT(t_cmd), t_end, fine, &log, NULL), 0);
}

static void write_log(const recorder *r)
{
  FILE *file = fopen(scratch_path("log.csv"), "w");
  static const double memory = 0.975;
  double coloured_p = fixture_normal(&seed), coloured_x = fixture_normal(&seed), slow = 0;
  int k;
  assert_non_null(file);
  fputs("t [s],u [1],p [kPa],x [mm]\n", file);
  for (k = 0; k * r->spacing < t_end; k++) {
    const double even = k * r->spacing, most = 0.49 * r->spacing,
                 off = fmin(fmax(r->jitter * fixture_normal(&seed), -most), most);
    const double t = r->stamped ? even : fmax(even + off, 0), shown = r->stamped ? fmax(even + off, 0) : even;
    const double swing = r->hum * sin(314.1592653589793 * t), fresh = sqrt(1 - r->memory * r->memory);
    double p = at(truth.p, t), x = at(truth.x, t);
    coloured_p = r->memory * coloured_p + fresh * fixture_normal(&seed);
    coloured_x = r->memory * coloured_x + fresh * fixture_normal(&seed);
    if (r->wander > 0)
      slow = memory * slow + r->wander * sqrt(1 - memory * memory) * fixture_normal(&seed);
    p = converted(p + noise_p * (r->quiet * coloured_p + swing + slow), rig.supply, r->bits);
    x = converted(x + noise_x * (r->quiet * coloured_x + swing), rig.stroke, r->bits);
    fprintf(file, "%.5f,%g,%.5f,%.6f\n", stamp(r, k, shown), truth.u[(int)(t / fine + 1e-6)], p * 1e-3, x * 1e3);
  }
  fclose(file);
}

static void write_rig(const recorder *r, const char *more)
{
  char text[1200];
  snprintf(text, sizeof text,
           "actuator = { area = \"%g m^2\"; dead_volume = \"%g m^3\"; stroke = \"%g m\"; spring_rate = \"%g N/m\";\n"
           "  spring_preload = \"%g m\"; moving_mass = \"%g kg\"; dry_friction = \"480 N\";\n"
           "  viscous_friction = \"%g N.s/m\"; damping = \"0 N.s/m\"; };\n"
           "transducer = { fill_area = \"%g m^2\"; vent_area = \"%g m^2\"; };\n"
           "supply = { pressure = \"%g Pa\"; temperature = \"%g K\"; };\n"
           "ambient = { pressure = \"%g Pa\"; temperature = \"%g K\"; };\n"
           "laws = { gas = \"isothermal\"; flow = \"choked\"; };\n"
           "fit = (\"orifice_area\", \"dry_friction\", \"spring_rate\", \"spring_preload\");\n"
           "noise = { pressure = \"%g Pa\"; position = \"%g m\"; };\n%s",
           rig.area, rig.dead_volume, rig.stroke, rig.spring_rate, rig.spring_preload, rig.mass, rig.viscous,
           rig.fill_area, rig.vent_area, rig.supply, rig.supply_temperature, rig.ambient, rig.ambient_temperature,
           r->declared * r->quiet * noise_p, r->declared * r->quiet * noise_x, more);
  scratch_text("rig.cfg", text);
}

/* The answer to the log and the rig file that were written, to be freed. */
static lab_answer *find_answer(void)
{
  char path[512], rig_path[512];
  const char *log[] = {path};
  const lab_request q = {.rig = rig_path, .log = log, .n_logs = 1, .alpha = 0.01, .min_gain = 0.02};
  lab_answer *answer;
  strcpy(path, scratch_path("log.csv"));
  strcpy(rig_path, scratch_path("rig.cfg"));
  succeed(lab_answer_find(&q, &answer, &error));
  return answer;
}

/* The answer to a log of the present truth, to be freed. */
static lab_answer *answer_to(const recorder *r)
{
  check_note("%s", r->name);
  seed = 20;
  write_rig(r, "");
  write_log(r);
  return find_answer();
}

static const recorder *const recorders[] = {&as_declared, &rounded, &late,     &stamped, &ten_bits,
                                            &plain_steps, &humming, &coloured, &noisier, &quieter,
                                            &controller,  &cut,     &wandering};

/* ---- Verdicts ---- */

TEST(test_lab_answer_find__nothing_missing__nothing_is_named_however_it_was_recorded)
{
  int k;
  run_truth(0);
  for (k = 0; k < COUNT(recorders); k++) {
    lab_answer *a = answer_to(recorders[k]);
    if (a->now.result.verdict != LAB_VERDICT_NONE)
      fail_msg("%s: %s", recorders[k]->name, lab_verdict_text(a->now.result.verdict));
    lab_answer_free(a);
  }
}

TEST(test_lab_answer_find__leak__is_named_however_it_was_recorded)
{
  int k;
  fixture_need("chamber_leak");
  run_truth(0.02);
  for (k = 0; k < COUNT(recorders); k++) {
    lab_answer *a = answer_to(recorders[k]);
    if (a->now.result.verdict != LAB_VERDICT_EFFECT || a->now.result.n_found != 1 ||
        a->now.result.found[0].effect != pneu_effect_find("chamber_leak"))
      fail_msg("%s: %s, %d found", recorders[k]->name, lab_verdict_text(a->now.result.verdict), a->now.result.n_found);
    lab_answer_free(a);
  }
}

/* ---- What is recognised ---- */

enum { P, X };

TEST(test_lab_answer_find__each_recorder__is_recognised)
{
  const double step = 1.25 * 0.02 / 1024;
  lab_answer *a;
  run_truth(0);
  a = answer_to(&as_declared);
  assert_int_equal(a->now.logs.limitations.n, 0);
  assert_close(a->now.logs.run[0].level[P], 1, 0, 0.1);
  assert_close(a->now.logs.run[0].jitter, 0, 0, 0);
  assert_close(a->now.logs.log[0].hum[LAB_CHANNEL_P].amplitude, 0, 0, 0);
  lab_answer_free(a);
  a = answer_to(&rounded);
  assert_close(a->now.logs.log[0].clock_step, 0.01, 0, 1e-9);
  assert_close(a->now.logs.log[0].value[LAB_CHANNEL_TIME][1000], 12, 1e-4, 0);
  lab_answer_free(a);
  a = answer_to(&late);
  assert_close(a->now.logs.run[0].jitter, 0.003, 0, 0.3);
  lab_answer_free(a);
  a = answer_to(&cut);
  assert_close(a->now.logs.log[0].stamp_step, 0.02, 0, 1e-9);
  assert_between(a->now.logs.run[0].jitter, 0.003, 0.01);
  lab_answer_free(a);
  a = answer_to(&plain_steps);
  assert_close(a->now.logs.run[0].resolution[X], step, 0, 1e-3);
  assert_close(a->now.logs.run[0].sigma[X], hypot(0.2 * noise_x, step / sqrt(12)), 0, 1e-3);
  lab_answer_free(a);
  a = answer_to(&humming);
  assert_close(a->now.logs.log[0].hum[LAB_CHANNEL_P].frequency, 50, 0.01, 0);
  assert_close(a->now.logs.log[0].hum[LAB_CHANNEL_P].amplitude, 3 * noise_p, 0, 0.05);
  assert_close(a->now.logs.log[0].hum[LAB_CHANNEL_X].amplitude, 3 * noise_x, 0, 0.05);
  lab_answer_free(a);
  a = answer_to(&controller);
  assert_true(a->now.logs.run[0].on_rows);
  lab_answer_free(a);
  a = answer_to(&as_declared);
  assert_false(a->now.logs.run[0].on_rows);
  lab_answer_free(a);
  a = answer_to(&noisier);
  assert_close(a->now.logs.run[0].level[P], 3, 0, 0.1);
  assert_close(a->now.logs.run[0].sigma[P], noise_p, 0, 0.1);
  lab_answer_free(a);
}

/* ---- Opening and set position in one log ---- */

static const second_positioner loop = {.gain = 14, .dead_band = 0.005, .cutoff_high = 1};

/* A loop whose opening was logged as 0 all the time, or commands beside a set position that was. */
static void write_loop(int is_loop)
{
  static const double t_set[] = {0.9, 7, 13, 19}, set[] = {0.6, 0.2, 0.8, 0.4}, spacing = 0.02;
  const second_course course = {.t_cmd = t_set, .u_cmd = set, .n = COUNT(t_set), .positioner = &loop};
  const second_log log = {.t = truth.t, .u = truth.u, .p = truth.p, .x = truth.x};
  FILE *file = fopen(scratch_path("log.csv"), "w");
  int k, steps = 0;
  assert_non_null(file);
  run_truth(0);
  if (is_loop)
    assert_int_equal(second_follow(&rig, &course, t_end, fine, &log, NULL), 0);
  fputs("t [s],u [1],sp [1],p [kPa],x [mm]\n", file);
  for (k = 0; k * spacing < t_end; k++) {
    const double t = k * spacing;
    steps += steps < (int)COUNT(t_set) && t >= t_set[steps] - 1e-9;
    fprintf(file, "%.5f,%g,%g,%.5f,%.6f\n", t, is_loop ? 0 : truth.u[(int)(t / fine + 1e-6)],
            is_loop && steps > 0 ? set[steps - 1] : 0, (at(truth.p, t) + noise_p * fixture_normal(&seed)) * 1e-3,
            (at(truth.x, t) + noise_x * fixture_normal(&seed)) * 1e3);
  }
  fclose(file);
}

TEST(test_lab_answer_find__u_and_set_position__what_explains_the_log_drives)
{
  int is_loop;
  for (is_loop = 0; is_loop < 2; is_loop++) {
    lab_answer *answer;
    seed = 20;
    write_loop(is_loop);
    write_rig(&as_declared, "positioner = { gain = 14; dead_band = \"0.5 %\"; };\n");
    answer = find_answer();
    assert_int_equal(answer->now.logs.n_without_u, is_loop);
    assert_int_equal(answer->now.result.verdict, LAB_VERDICT_NONE);
    lab_answer_free(answer);
  }
}
