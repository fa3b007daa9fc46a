/* tests/blind: what is drawn for logs "as recorded", what sensors and loggers do to them, and what they can show. */
#include "../scratch.h"

#include "recorded_limit.h"

static blind_recorded draw(int number)
{
  blind_recorded r;
  blind_draw_recorded(1, number, 0, &r);
  return r;
}

/* ---- Drawing ---- */

TEST(test_blind_draw_recorded__same_number__same_rig_and_effect_as_the_clean_trial)
{
  int k;
  for (k = 0; k < 100; k++) {
    const blind_recorded r = draw(k), again = draw(k);
    blind_trial clean;
    blind_draw(1, k, &clean);
    assert_memory_equal(&r, &again, sizeof r);
    assert_memory_equal(&r.t.declared, &clean.declared, sizeof clean.declared);
    if (!(r.has & (1u << BLIND_TURBULENT)))
      assert_memory_equal(r.t.missing, clean.missing, sizeof clean.missing);
  }
}

static int has(const blind_recorded *r, int imperfection)
{
  return (r->has >> imperfection) & 1;
}

/* A line by its name, a supply's or a tube's, or any other effect. */
static int is_supply(const blind_missing *m)
{
  return strcmp(m->effect->name, "supply_droop") == 0;
}

static int is_line(const blind_missing *m)
{
  return is_supply(m) || strcmp(m->effect->name, "connecting_tube") == 0;
}

static void assert_turbulent(const blind_recorded *r, int which)
{
  const blind_missing *m = &r->t.missing[which];
  const second_rig first = blind_recorded_first(r, BLIND_ALL), g = blind_recorded_later(r, BLIND_ALL);
  const double chamber = g.dead_volume + g.area * g.stroke;
  check_note("trial %d", r->t.number);
  assert_between(m->size * blind_full_flow(&r->t.base) / r->t.base.supply, 0.00299, 0.301);
  assert_close(is_supply(m) ? g.supply_droop : g.tube_resistance, m->size, 0, 0);
  assert_close(is_supply(m) ? g.supply_turbulence : g.tube_turbulence, 1, 0, 0);
  assert_close(first.supply_volume, g.supply_volume, 0, 0);
  if (is_supply(m) && has(r, BLIND_ONSET))
    assert_close(g.supply_volume, 0, 0, 0);
  else if (is_supply(m) && r->beyond < 0)
    assert_between(g.supply_volume / chamber, 0.0199, 0.301);
}

TEST(test_blind_draw_recorded__many__half_of_the_lines_are_turbulent)
{
  int lines = 0, turbulent = 0, begin = 0, k, i;
  for (k = 0; k < 4000; k++) {
    const blind_recorded r = draw(k);
    const second_rig g = blind_recorded_later(&r, BLIND_ALL);
    for (i = 0; i < r.t.n_missing; i++) {
      if (!is_line(&r.t.missing[i]))
        continue;
      lines++;
      turbulent += has(&r, BLIND_TURBULENT);
      begin += has(&r, BLIND_TURBULENT) && has(&r, BLIND_ONSET);
      if (has(&r, BLIND_TURBULENT))
        assert_turbulent(&r, i);
      else
        assert_close(g.supply_turbulence + g.supply_volume + g.tube_turbulence, 0, 0, 0);
    }
  }
  assert_between(lines, 150, 300);
  assert_between((double)turbulent / lines, 0.4, 0.6);
  assert_true(begin > 0);
}

TEST(test_blind_draw_recorded__many__imperfections_have_their_share)
{
  enum { MANY = 4000 };
  int count[BLIND_IMPERFECTIONS] = {0}, plain = 0, k, i;
  for (k = 0; k < MANY; k++) {
    const blind_recorded r = draw(k);
    plain += r.has == 0;
    for (i = 0; i < BLIND_IMPERFECTIONS; i++)
      count[i] += (r.has >> i) & 1;
  }
  for (i = 0; i < BLIND_IMPERFECTIONS; i++) {
    double share = 0.9 * blind_imperfections[i].share;
    if (i == BLIND_ONSET || i >= BLIND_TURBULENT) /* not every trial can have these */
      continue;
    if (i == BLIND_BEYOND) /* an onset takes its place where nothing is missing */
      share *= 1 - 0.15 * blind_imperfections[BLIND_ONSET].share;
    if (i == BLIND_NOISE_WRONG) /* of the noise that is told */
      share *= 1 - blind_imperfections[BLIND_NOISE_UNTOLD].share;
    check_note("%s", blind_imperfections[i].name);
    assert_between((double)count[i] / MANY, share - 0.03, share + 0.03);
  }
  assert_between((double)count[BLIND_ONSET] / MANY, 0.1, 0.3);
  assert_between((double)plain / MANY, 0.1, 0.15);
}

TEST(test_blind_draw_recorded__many__values_are_off_by_their_tolerance)
{
  enum { MANY = 3000 };
  double squares[BLIND_VALUES] = {0};
  int n[BLIND_VALUES] = {0}, k, i;
  for (k = 0; k < MANY; k++) {
    const blind_recorded r = draw(k);
    for (i = 0; i < BLIND_VALUES; i++) {
      const double known = r.told[i] > 0 ? r.told[i] : blind_values[i].tolerance;
      const double z = (blind_values[i].absolute ? r.off[i] : r.off[i] - 1) / known;
      if (i == r.beyond)
        continue;
      check_note("trial %d, %s", k, blind_values[i].name);
      assert_between(z, -2.0001, 2.0001);
      squares[i] += z * z;
      n[i]++;
    }
  }
  for (i = 0; i < BLIND_VALUES; i++) { /* a normal cut at two has 0.880; friction and damping are cut below, too */
    check_note("%s", blind_values[i].name);
    assert_between(sqrt(squares[i] / n[i]), 0.8, 0.95);
  }
}

TEST(test_blind_draw_recorded__many__vents_differ_from_fill_orifices_by_a_twentieth)
{
  enum { MANY = 1000 };
  double squares = 0;
  int k;
  for (k = 0; k < MANY; k++) {
    const blind_recorded r = draw(k);
    assert_close(r.t.base.vent_area / r.t.base.fill_area, r.vent, 0, 1e-12);
    squares += (r.vent - 1) * (r.vent - 1);
  }
  assert_between(sqrt(squares / MANY) / 0.05, 0.84, 0.92);
}

TEST(test_blind_draw_recorded__beyond__is_3_to_6_tolerances_off)
{
  int k, seen = 0, more = 0;
  for (k = 0; k < 2000; k++) {
    const blind_recorded r = draw(k);
    const int i = r.beyond;
    double known, off;
    if (i < 0 || r.onset_value >= 0 || strcmp(blind_values[i].name, "dry_friction") == 0) /* which is kept moving */
      continue;
    known = r.told[i] > 0 ? r.told[i] : blind_values[i].tolerance;
    off = blind_values[i].absolute ? -r.off[i] : r.off[i] > 1 ? r.off[i] - 1 : 1 / r.off[i] - 1;
    check_note("trial %d, %s", k, blind_values[i].name);
    assert_between(off / known, 2.9999, 6.0001);
    assert_true(r.has & (1u << BLIND_BEYOND));
    more += r.off[i] > 1;
    seen++;
  }
  assert_between(seen, 300, 600);
  assert_between((double)more / seen, 0.3, 0.6);
}

/* What is left out leaves all else as it was, but for what a loop alone can have. */
TEST(test_blind_draw_recorded__without__has_none_of_it)
{
  const unsigned of_loops = 1u << BLIND_INTEGRAL | 1u << BLIND_LONG_RAMPS;
  unsigned without;
  int k;
  assert_int_equal(blind_imperfections_read("positioner,hum", &without), 1);
  assert_int_equal(without, 1u << BLIND_POSITIONER | 1u << BLIND_HUM);
  assert_int_equal(blind_imperfections_read("positioner,humm", &without), 0);
  without = 1u << BLIND_POSITIONER | 1u << BLIND_HUM;
  for (k = 0; k < 100; k++) {
    const blind_recorded all = draw(k);
    blind_recorded r;
    blind_draw_recorded(1, k, without, &r);
    assert_int_equal(r.has, all.has & ~(without | of_loops));
    assert_int_equal(r.loop, BLIND_OPEN);
    assert_close(r.hum[0] + r.hum[1], 0, 0, 0);
    assert_memory_equal(r.off, all.off, sizeof r.off);
  }
}

TEST(test_blind_draw_recorded__many__half_of_the_integrals_are_not_0_at_first)
{
  int loops = 0, worked = 0, up = 0, k;
  for (k = 0; k < 4000; k++) {
    const blind_recorded r = draw(k);
    const second_positioner *p = &r.positioner;
    const int can = r.loop != BLIND_OPEN && p->integral_time > 0;
    check_note("trial %d", k);
    loops += can;
    worked += p->integral_start != 0;
    up += p->integral_start > 0;
    assert_int_equal(p->integral_start != 0, has(&r, BLIND_INTEGRAL));
    assert_true(can || p->integral_start == 0);
    assert_between(p->gain * p->integral_start, -0.3, 0.3);
  }
  assert_between((double)worked / loops, 0.45, 0.55);
  assert_between((double)up / worked, 0.4, 0.6);
}

/* Time of its moves; the longest run of ramps without a hold between them. */
static double longest_ramp(const blind_recorded *r)
{
  double longest = 0, begins = 0, ends = -1;
  int i;
  for (i = 0; i < r->n_moves; i++) {
    const blind_move *m = &r->move[i];
    assert_true(i == 0 || m->t >= ends);
    begins = m->ramp > 0 && m->t > ends + 1e-9 ? m->t : begins;
    ends = m->t + m->ramp;
    longest = m->ramp > 0 ? fmax(longest, ends - begins) : longest;
  }
  assert_true(ends <= r->end * (1 + 1e-12));
  return longest;
}

TEST(test_blind_draw_recorded__many__some_loops_follow_long_ramps)
{
  int loops = 0, ramps = 0, back = 0, whole = 0, k;
  for (k = 0; k < 2000; k++) {
    const blind_recorded r = draw(k);
    const double from = r.move[0].to, to = r.move[1].to;
    check_note("trial %d", k);
    loops += r.loop != BLIND_OPEN;
    if (r.loop == BLIND_OPEN || !has(&r, BLIND_LONG_RAMPS)) {
      assert_int_equal(has(&r, BLIND_LONG_RAMPS), 0);
      continue;
    }
    ramps++;
    back += r.n_moves > 2 && r.move[2].ramp == r.move[1].ramp && r.move[2].to == from;
    whole += longest_ramp(&r) > 0.9 * (r.end - r.move[1].t);
    assert_true(longest_ramp(&r) > 0.33 * r.end);
    assert_between(fabs(to - from), 0.2, 1);
    assert_between(to, 0.05, 0.95);
  }
  assert_between((double)ramps / loops, 0.2, 0.34); /* 0.27: some are plain */
  assert_between((double)back / ramps, 0.4, 0.6);
  assert_true(whole > 0);
}

/* ---- Lines ---- */

/* p of the trial at a step of the generator, noise-free; to be freed. */
static blind_fine run_at(const blind_recorded *r, double step)
{
  const second_rig g = blind_recorded_later(r, BLIND_ALL);
  blind_fine fine;
  succeed(blind_run_recorded(r, &g, &g, step, &fine, &error));
  return fine;
}

/* The least that is drawn follows at once: three times the step of the trial, as for what a log can show, is short
 * enough. */
static void assert_step_is_short_enough(const char *name)
{
  blind_recorded r = draw(0);
  blind_missing *m = &r.t.missing[0];
  blind_fine coarse, fine;
  size_t i;
  m->effect = blind_turbulent_of(blind_effect_named(name));
  m->size = m->effect->lo * blind_scale_of(m->effect->scale, &r.t.base);
  m->shape[0] = m->effect->shape[0].lo * blind_scale_of(m->effect->shape[0].scale, &r.t.base);
  r.t.n_missing = 1;
  r.end = r.move[2].t;
  coarse = run_at(&r, 3 * m->effect->step);
  fine = run_at(&r, 0.5 * m->effect->step);
  check_note("%s", name);
  for (i = 0; i < fine.rows.n; i++)
    assert_close(coarse.rows.p[i], fine.rows.p[i], 1e-5 * r.t.base.supply, 0);
  blind_fine_free(&coarse);
  blind_fine_free(&fine);
}

TEST(test_blind_run_recorded__least_turbulent_lines__are_followed_at_their_step)
{
  assert_step_is_short_enough("supply_droop");
  assert_step_is_short_enough("connecting_tube");
}

/* ---- Sensors and logger ---- */

/* A trial of 20 s at 100 rows a second with p and x and nothing that soils it; spans are 1. */
static blind_recorded bare(void)
{
  blind_recorded r = {0};
  r.t.declared.supply = r.t.declared.stroke = 1;
  r.t.channels = BLIND_P | BLIND_X;
  r.end = 20;
  r.spacing = 0.01;
  r.bits = 40;
  r.memory = 0.1;
  r.onset = NAN;
  r.seed = 5;
  return r;
}

/* What it records of a rig whose p and x are given at every millisecond; to be freed. */
static blind_log record(const blind_recorded *r, double (*of)(double t))
{
  blind_fine fine = {.spacing = 1e-3};
  blind_log log;
  size_t i;
  fine.rows.n = second_samples(r->end, fine.spacing);
  fine.rows.t = calloc(5 * fine.rows.n, sizeof(double));
  fine.rows.u = fine.rows.t + fine.rows.n;
  fine.rows.p = fine.rows.u + fine.rows.n;
  fine.rows.x = fine.rows.p + fine.rows.n;
  fine.rows.T = fine.rows.x + fine.rows.n;
  for (i = 0; i < fine.rows.n; i++)
    fine.rows.p[i] = fine.rows.x[i] = of((double)i * fine.spacing);
  succeed(blind_spoil(r, &fine, &log, &error));
  blind_fine_free(&fine);
  return log;
}

static double still(double t)
{
  (void)t;
  return 0.5;
}

static double step(double t)
{
  return t < 1 ? 0 : 1;
}

static double slope(double t)
{
  return 0.05 * t;
}

TEST(test_blind_spoil__nothing__shows_what_is_there)
{
  const blind_recorded r = bare();
  blind_log log = record(&r, slope);
  size_t i;
  assert_int_equal(log.n, 2001);
  for (i = 0; i < log.n; i++) {
    assert_close(log.t[i], (double)i * 0.01, 1e-12, 0);
    assert_close(log.p[i], slope(log.t[i]), 1e-9, 0);
    assert_close(log.x[i], slope(log.t[i]), 1e-9, 0);
  }
  blind_log_free(&log);
}

TEST(test_blind_spoil__filter__has_its_time_constant)
{
  blind_recorded r = bare();
  blind_log log;
  r.filter[0] = 0.02;
  r.filter[1] = 0.03;
  log = record(&r, step);
  assert_close(log.p[99], 0, 1e-9, 0);
  assert_close(log.p[102], 1 - exp(-1), 0.02, 0); /* a time constant after the step, */
  assert_close(log.x[103], 1 - exp(-1), 0.02, 0); /* which rises within a millisecond */
  assert_close((1 - log.p[104]) / (1 - log.p[102]), exp(-1), 1e-9, 0);
  blind_log_free(&log);
  log = record(&r, slope);
  assert_close(slope(log.t[1000]) - log.p[1000], 0.05 * 0.02, 1e-9, 0);
  blind_log_free(&log);
}

TEST(test_blind_spoil__bits__are_steps_of_the_range)
{
  blind_recorded r = bare();
  const double quantum = 1.25 / 1024;
  blind_log log;
  size_t i;
  r.bits = 10;
  log = record(&r, slope);
  for (i = 0; i < log.n; i++) {
    assert_close(log.p[i] / quantum, floor(log.p[i] / quantum + 0.5), 1e-9, 0);
    assert_between(log.p[i] - slope(log.t[i]), -0.5001 * quantum, 0.5001 * quantum);
  }
  blind_log_free(&log);
}

TEST(test_blind_spoil__rounding_and_jitter__move_time_and_sample)
{
  blind_recorded r = bare();
  double square = 0;
  blind_log log;
  size_t i;
  r.spacing = 0.013;
  r.rounding = 0.005;
  r.jitter = 0.001;
  log = record(&r, slope);
  for (i = 1; i < log.n; i++) {
    const double meant = (double)i * r.spacing;
    assert_between(log.t[i] - meant, -0.0025001, 0.0025001);
    assert_close(log.t[i] / 0.005, floor(log.t[i] / 0.005 + 0.5), 1e-9, 0);
    assert_true(log.t[i] > log.t[i - 1]);
    if (log.at[i] < r.end)
      assert_close(log.p[i], slope(log.at[i]), 1e-9, 0);
    square += (log.at[i] - meant) * (log.at[i] - meant);
  }
  assert_close(sqrt(square / (double)(log.n - 1)), 0.001, 0, 0.1);
  blind_log_free(&log);
}

static double deviation(const double *y, size_t n)
{
  double sum = 0, square = 0;
  size_t i;
  for (i = 0; i < n; i++)
    sum += y[i];
  for (i = 0; i < n; i++)
    square += (y[i] - sum / (double)n) * (y[i] - sum / (double)n);
  return sqrt(square / (double)n);
}

/* Correlation of neighbours. */
static double memory_of(const double *y, size_t n)
{
  const double mean = 0.5;
  double own = 0, next = 0;
  size_t i;
  for (i = 0; i + 1 < n; i++) {
    own += (y[i] - mean) * (y[i] - mean);
    next += (y[i] - mean) * (y[i + 1] - mean);
  }
  return next / own;
}

TEST(test_blind_spoil__colour__has_its_level_and_memory)
{
  blind_recorded r = bare();
  blind_log log;
  r.end = 200;
  r.t.declared.pressure_noise = r.t.declared.position_noise = 0.01;
  r.colour[1] = 3;
  log = record(&r, still);
  assert_close(deviation(log.p, log.n), 0.01, 0, 0.03);
  assert_close(memory_of(log.p, log.n), 0, 0.03, 0);
  assert_close(deviation(log.x, log.n), 0.01 * sqrt(10), 0, 0.1);
  assert_close(memory_of(log.x, log.n), 0.9 * exp(-0.1), 0.05, 0);
  blind_log_free(&log);
}

TEST(test_blind_spoil__hum_and_drift__are_of_the_span)
{
  blind_recorded r = bare();
  size_t i;
  blind_log log;
  r.hum[0] = 0.002;
  r.mains = 10; /* five rows are half a period */
  r.drift[1] = -0.004;
  log = record(&r, still);
  assert_close(deviation(log.p, log.n), 0.002 / sqrt(2), 0, 0.01);
  for (i = 0; i + 5 < log.n; i++)
    assert_close(log.p[i] + log.p[i + 5], 1, 1e-9, 0);
  assert_close(log.x[0], 0.5, 1e-9, 0);
  assert_close(log.x[log.n - 1], 0.496, 1e-5, 0);
  blind_log_free(&log);
}

TEST(test_blind_spoil__dropouts__empty_fields_missing_rows_and_a_gap)
{
  blind_recorded r = bare();
  double longest = 0;
  size_t i, empty = 0;
  blind_log log;
  r.end = 100;
  r.lost = 0.02;
  r.gap_at = 40;
  r.gap = 0.5;
  log = record(&r, still);
  for (i = 1; i < log.n; i++) {
    empty += isnan(log.p[i]) != 0;
    longest = fmax(longest, log.t[i] - log.t[i - 1]);
  }
  assert_between(empty / (double)log.n, 0.015, 0.025);
  assert_between(1 - (double)(log.n + 50) / 10001, 0.006, 0.014);
  assert_close(longest, 0.51, 0.021, 0);
  blind_log_free(&log);
}

/* ---- Files ---- */

TEST(test_blind_write_recorded__many__are_logs_with_their_channels)
{
  static const char *const heads[BLIND_LOOPS] = {"t [s],u [1],", "t [s],u [1],sp [%],p [kPa],x [mm]",
                                                 "t [s],sp [%],p [kPa],x [mm]", "t [s],sp [%],x [mm]"};
  int seen[BLIND_LOOPS] = {0}, k;
  for (k = 0; k < 60; k++) {
    blind_recorded r = draw(k);
    char *rig, *log, path[600];
    size_t rows;
    if (seen[r.loop]++ > 1)
      continue;
    r.end = 2;
    r.t.step = 1e-4;
    check_note("trial %d", k);
    succeed(blind_write_recorded(&r, scratch_path("recorded"), &rows, &error));
    snprintf(path, sizeof path, "%s/rig.cfg", scratch_path("recorded"));
    rig = scratch_read(path);
    snprintf(path, sizeof path, "%s/fit.csv", scratch_path("recorded"));
    log = scratch_read(path);
    assert_int_equal(strncmp(log, heads[r.loop], strlen(heads[r.loop])), 0);
    assert_int_equal(strstr(rig, "positioner") != NULL, r.loop != BLIND_OPEN);
    assert_int_equal(strstr(rig, "tolerance ") != NULL, (r.has >> BLIND_TOLERANCE) & 1);
    assert_int_equal(strstr(rig, "noise ") != NULL, !(r.has >> BLIND_NOISE_UNTOLD & 1));
    free(rig);
    free(log);
  }
  for (k = 0; k < BLIND_LOOPS; k++)
    assert_true(seen[k] > 0);
}

/* ---- What a log can show ---- */

/* Number of the first trial that is open, has both channels, nothing missing and nothing that begins. */
static int plain_number(void)
{
  int k;
  for (k = 0; k < 500; k++) {
    const blind_recorded r = draw(k);
    if (r.loop == BLIND_OPEN && r.t.n_missing == 0 && isnan(r.onset) && r.t.channels == (BLIND_P | BLIND_X))
      return k;
  }
  fail_msg("no such trial");
  return -1;
}

/* Area, forces, mass, volume and orifices grown alike do the same: area alone cannot be told but by what is known of
 * mass and volume. Orifices can, against the supply pressure. */
TEST(test_blind_recorded_visible__area__is_known_by_the_tolerance_of_mass_and_volume)
{
  const int area = blind_value_named("area"), orifice = blind_value_named("orifice_area");
  const int volume = blind_value_named("dead_volume"), mass = blind_value_named("moving_mass");
  blind_recorded r = draw(plain_number());
  blind_visible v;
  double bound;
  r.off[area] = 1.05;
  memset(r.told, 0, sizeof r.told);
  succeed(blind_recorded_visible(&r, &v, &error));
  bound = 0.05 / 1.05 / blind_values[volume].tolerance;
  bound = bound * bound + pow(0.05 / 1.05 / blind_values[mass].tolerance, 2);
  assert_between(v.value[area], 0, 1.1 * bound);
  assert_true(v.value[orifice] > 100 * pow(fabs(1 - 1 / r.off[orifice]) / 0.2, 2));
}

TEST(test_blind_recorded_visible__noise_and_converter__hide)
{
  const int friction = blind_value_named("dry_friction");
  blind_recorded r = draw(plain_number());
  blind_visible fine, noisy, coarse;
  r.bits = 14;
  succeed(blind_recorded_visible(&r, &fine, &error));
  r.bits = 3;
  succeed(blind_recorded_visible(&r, &coarse, &error));
  r.bits = 14;
  r.t.declared.pressure_noise *= 100;
  r.t.declared.position_noise *= 100;
  succeed(blind_recorded_visible(&r, &noisy, &error));
  assert_between(coarse.value[friction], 0, 0.1 * fine.value[friction]);
  assert_between(noisy.value[friction], 0, 0.1 * fine.value[friction]);
}
