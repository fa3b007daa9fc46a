/* From a log with a positioner in the loop, of the independent rig, to what the declared model lacks. */
#include "../../scratch.h"
#include "../../second/rig.h"

#include "../../../apps/lab/check/logs.h"
#include "../../../apps/lab/trace/departure.h"
#include "../../../apps/lab/trace/forces.h"
#include "../../../apps/lab/trace/search.h"
#include "../../../apps/lab/trace/standing.h"

enum { ROWS = 2001, CHANGES = 400 };
static const double spacing = 0.02, lasting = 40; /* [s] */

/* What a log has. */
enum { WITH_U = 1, WITH_SP = 2, WITH_P = 4 };

/* An experiment: the true rig and its positioner, and the set positions. */
static second_rig g;
static second_positioner k;
static double t_set[CHANGES], set[CHANGES];
static double leaks_since, leak_since; /* [s], [m2]: a leak that begins; 0: none */
static double rises_by;                /* [N] friction then */
static double softens_to;              /* times the spring rate then */
static size_t n_set;

static int fits_nothing; /* all is as the sheet says, to its tolerance */

static lab_logs logs;
static lab_unknowns u;
static lab_search_result result;

/* A staircase of ten levels, each held for 4 s. */
static void set_stairs(void)
{
  static const double level[] = {0, 0.3, 0.6, 0.45, 0.8, 0.75, 0.2, 1, 0.7, 0.1};
  for (n_set = 0; n_set < sizeof level / sizeof *level; n_set++) {
    t_set[n_set] = 4 * (double)n_set;
    set[n_set] = level[n_set];
  }
}

/* What a controller sends ten times a second. */
static void set_waves(void)
{
  for (n_set = 0; n_set < CHANGES; n_set++) {
    t_set[n_set] = 0.1 * (double)n_set;
    set[n_set] = 0.5 - 0.4 * cos(0.4 * t_set[n_set]);
  }
}

static int begin(void **state)
{
  g = second_rig_default_r1_400();
  g.flow = SECOND_CHOKED;
  g.dead_volume = 4e-5;
  g.dry_friction = 300;
  g.fill_area = g.vent_area = 1.786e-6;
  g.pressure_noise = 300;
  g.position_noise = 1e-5;
  g.step = 1e-4;
  g.seed = 1;
  k = (second_positioner){.gain = 20, .dead_band = 0.002, .cutoff_low = 0.01, .cutoff_high = 0.99};
  fits_nothing = 0;
  leak_since = leaks_since = rises_by = 0;
  softens_to = 1;
  set_stairs();
  return 0;
}

#define CASE(name) TEST_WITH(name, begin, NULL)

static double set_at(double t)
{
  size_t i = 0;
  while (i < n_set && t_set[i] <= t + 1e-9)
    i++;
  return set[i - 1];
}

static const char *write_log(int columns)
{
  static double t[ROWS], sent[ROWS], p[ROWS], x[ROWS];
  second_rig later = g;
  const second_course course = {.t_cmd = t_set,
                                .u_cmd = set,
                                .n = n_set,
                                .positioner = &k,
                                .later = leaks_since > 0 ? &later : NULL,
                                .change = leaks_since};
  second_log log = {.t = t, .u = sent, .p = p, .x = x};
  const char *path = scratch_path("log.csv");
  FILE *file = fopen(path, "w");
  int i;
  later.leak_area += leak_since;
  later.dry_friction += rises_by;
  later.spring_rate *= softens_to;
  assert_non_null(file);
  assert_int_equal(second_samples(lasting, spacing), ROWS);
  assert_int_equal(second_follow(&g, &course, lasting, spacing, &log, NULL), 0);
  fprintf(file, "t [s],x [mm]%s%s%s\n", columns & WITH_U ? ",u [1]" : "", columns & WITH_SP ? ",sp [%]" : "",
          columns & WITH_P ? ",p [kPa]" : "");
  for (i = 0; i < ROWS; i++) {
    fprintf(file, "%.2f,%.5f", t[i], 1e3 * x[i]);
    if (columns & WITH_U)
      fprintf(file, ",%.6f", sent[i]);
    if (columns & WITH_SP)
      fprintf(file, ",%.4f", 100 * set_at(t[i]));
    fprintf(file, columns & WITH_P ? ",%.4f\n" : "\n", 1e-3 * p[i]);
  }
  assert_int_equal(fclose(file), 0);
  return path;
}

static const char declared[] =
    "actuator = { area = \"400 cm^2\"; dead_volume = \"40 cm^3\"; stroke = \"20 mm\"; spring_rate = \"400 kN/m\";"
    " spring_preload = \"10 mm\"; moving_mass = \"2 kg\"; dry_friction = \"330 N\"; viscous_friction = \"500 N.s/m\";"
    " damping = \"1000 N.s/m\"; };\n"
    "transducer = { fill_area = \"1.7 mm^2\"; vent_area = \"1.7 mm^2\"; };\n"
    "supply = { pressure = \"4 bar\"; };\nlaws = { flow = \"choked\"; };\n"
    "fit = ( \"orifice_area\", \"dry_friction\" );\nnoise = { pressure = \"300 Pa\"; position = \"0.01 mm\"; };\n"
    "positioner = { gain = 20; dead_band = \"0.2 %\"; cutoff_low = \"1 %\"; cutoff_high = \"99 %\"; };\n";

/* Fit the declared model to a log of the experiment. */
static void open_loop(int columns)
{
  static lab_rig rig;
  char text[sizeof declared];
  memcpy(text, declared, sizeof declared);
  if (fits_nothing)
    memcpy(strstr(text, "fit"), "// ", 3);
  text[strstr(text, "0.2 %") - text + 2] = (char)('0' + (int)(1000 * k.dead_band + 0.5)); /* is known */
  memset(&logs, 0, sizeof logs);
  if (lab_rig_read(scratch_text("rig.cfg", text), &rig, &error) ||
      lab_logs_add(&logs, &rig, write_log(columns), &error) || lab_unknowns_open(&rig, logs.run, logs.n, &u, &error) ||
      lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error))
    fail_msg("%s", error.text);
}

static void close_loop(int columns)
{
  lab_search_options options;
  open_loop(columns);
  lab_search_options_default(&options);
  succeed(lab_search_run(&u, &options, &result, &error));
  lab_logs_close(&logs);
}

static void assert_found(const char *effect, const char *param, double value, double share)
{
  assert_int_equal(result.verdict, LAB_VERDICT_EFFECT);
  assert_int_equal(result.n_found, 1);
  assert_string_equal(pneu_effect_at(result.found[0].effect)->name, effect);
  assert_close(*pneu_param_at(&u.rig.params, pneu_param_find(param)), value, 0, share);
}

/* ---- Set position and travel ---- */

CASE(test_lab_search_run__set_position_and_travel__nothing_is_missing)
{
  const int area = 0; /* the first of `fit` */
  int friction;
  close_loop(WITH_SP);
  friction = lab_unknowns_find(&u, pneu_param_find("dry_friction"));
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_close(result.after.in_noise[LAB_CHANNEL_X], 1, 0.08, 0);
  assert_true(result.fit.low[area] < 1.786 / 1.7 && 1.786 / 1.7 < result.fit.high[area]);
  assert_close(result.fit.high[area] - result.fit.low[area], 0.0712, 0, 0.2);
  assert_true(result.fit.low[friction] < 300 && 300 < result.fit.high[friction]); /* known to a tenth */
  /* the stem passes the jump at the edge of the dead band a row sooner or later: 59 N, 70 N where rounding differs */
  assert_close(result.fit.high[friction] - result.fit.low[friction], 64, 0, 0.2);
}

CASE(test_lab_search_run__set_position_in_many_small_steps__is_no_hum)
{
  set_waves();
  close_loop(WITH_SP);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_close(result.after.in_noise[LAB_CHANNEL_X], 1, 0.08, 0);
}

CASE(test_lab_search_run__positioner_out_of_adjustment__is_named_and_sized)
{
  g.span = 0.03;
  close_loop(WITH_SP | WITH_P);
  assert_found("positioner_span", "positioner_span.span_excess", 0.03, 2e-2);
  begin(NULL);
  g.overlap = 0.05;
  close_loop(WITH_SP);
  assert_found("positioner_overlap", "positioner_overlap.overlap", 0.05, 5e-2);
}

CASE(test_lab_search_run__another_gain__is_a_value_that_is_off)
{
  k.gain = 14;
  close_loop(WITH_SP | WITH_P);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_close(*pneu_param_at(&u.rig.params, pneu_param_find("gain")), 14, 0, 2e-2);
}

/* One factor of both orifices is fitted: the vent is off beside the other by what orifices of one make are, or is
 * blocked. */
CASE(test_lab_search_run__vent_off_beside_the_fill__is_an_effect_beyond_its_tolerance)
{
  g.vent_area = 0.95 * g.fill_area;
  close_loop(WITH_SP | WITH_P);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_close((double)u.rig.params.ambient_pressure, 101325, 1000, 0);
  begin(NULL);
  g.vent_area = 0.6 * g.fill_area;
  close_loop(WITH_SP | WITH_P);
  assert_found("vent_restriction", "vent_restriction", 0.4, 2e-2);
}

/* A partial stroke test tells friction of three times its sheet from a spring that gives back less: that would have to
 * do so within a micron. */
CASE(test_lab_search_run__partial_stroke_and_more_friction__is_no_hysteresis)
{
  static const double level[] = {1, 0.9, 1, 0.85, 1};
  for (n_set = 0; n_set < sizeof level / sizeof *level; n_set++) {
    t_set[n_set] = n_set > 0 ? 8 * (double)n_set + 0.013 : 0;
    set[n_set] = level[n_set];
  }
  g.fill_area = g.vent_area = 1.7e-6;
  g.dry_friction = 990;
  fits_nothing = 1;
  close_loop(WITH_SP | WITH_P);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_close((double)u.rig.params.dry_friction, 990, 0, 0.05);
}

CASE(test_lab_search_run__supply_that_gives_way__is_seen_through_the_loop)
{
  g.supply_droop = 1e8;
  close_loop(WITH_SP);
  assert_found("supply_droop", "supply_droop.supply_resistance", 1e8, 5e-2);
}

/* Before the stem meets a stop nothing shows of it: no slope at its full stroke tells one at 70 %. */
CASE(test_lab_search_run__stop_that_comes_early__is_named_and_sized)
{
  g.travel_limit = 0.7 * g.stroke;
  set[7] = 0.9;
  close_loop(WITH_SP | WITH_P);
  assert_found("travel_limit", "travel_limit.travel_loss", 0.3 * g.stroke, 1e-2);
}

/* Half a row after all of them would be a dead time. */
static void send_between_rows(void)
{
  size_t i;
  for (i = 1; i < n_set; i++)
    t_set[i] += i % 2 ? 0.013 : 0.004;
}

/* A line of which resistance [Pa s/kg] and volume [m3] are found. */
static void assert_line_found(const char *effect, const char *resistance, double value, const char *volume, double air)
{
  send_between_rows();
  close_loop(WITH_SP | WITH_P);
  assert_found(effect, resistance, value, 5e-2);
  assert_close(*pneu_param_at(&u.rig.params, pneu_param_find(volume)), air, 0, 5e-2);
}

/* What resists as an orifice does is found by its form, beside which a linear one leaves more than noise. */
CASE(test_lab_search_run__kinked_tube_and_narrow_supply__are_named_and_sized)
{
  g.tube_resistance = 1e8;
  g.tube_turbulence = 1;
  g.tube_volume = 5e-5;
  assert_line_found("connecting_tube", "tube_resistance", 1e8, "tube_volume", 5e-5);
  begin(state);
  g.supply_droop = 2e8;
  g.supply_turbulence = 1;
  g.supply_volume = 3e-4;
  assert_line_found("supply_droop", "supply_resistance", 2e8, "supply_volume", 3e-4);
}

CASE(test_lab_search_run__leak_while_the_set_position_changes__is_named_and_sized)
{
  set_waves();
  g.leak_area = 3e-8;
  close_loop(WITH_SP | WITH_P);
  assert_found("chamber_leak", "chamber_leak.leak_area", 3e-8, 5e-2);
}

/* The positioner fills for as long as the chamber leaks, about once a second: from no leak no slope tells that. */
static void hold_within_a_wider_band(void)
{
  static const double level[] = {0.5, 0.47, 0.45, 0.51, 0.62, 0.6, 0.55, 0.4, 0.43, 0.48};
  size_t i;
  for (i = 0; i < n_set; i++)
    set[i] = level[i];
  k.dead_band = 0.003;
  g.dead_volume = 3e-5;
  g.spring_rate = 0.96 * 4e5;
}

/* What a log shows of a leak.  Returns: over its size */
static double shown(const char *param, double size, double *scatter)
{
  double seen;
  open_loop(WITH_SP | WITH_P);
  seen = lab_standing_leak(&u, pneu_param_find(param), HUGE_VAL, scatter);
  lab_logs_close(&logs);
  return seen / size;
}

/* The declared chamber is a third larger than the true one, of which the swept part is known; where the stem goes all
 * the way the pressures are so far apart that a hole and a gap differ. */
CASE(test_lab_standing_leak__pressure_falls_with_both_orifices_shut__is_about_the_size)
{
  double alike, other;
  hold_within_a_wider_band();
  g.leak_area = 6e-8;
  assert_close(shown("leak_area", 6e-8, &alike), 1, 0, 0.1);
  set_stairs();
  g.leak_area = 0;
  g.laminar_leak = 4.4e-16;
  assert_close(shown("laminar_leak", 4.4e-16, &alike), 1, 0, 0.1);
  shown("leak_area", 1, &other);
  assert_true(alike < other);
}

CASE(test_lab_standing_leak__no_leak_or_before_its_time__shows_none)
{
  double scatter;
  hold_within_a_wider_band();
  shown("leak_area", 1, &scatter);
  assert_false(scatter < 0.5);
  g.leak_area = 6e-8;
  open_loop(WITH_SP | WITH_P);
  assert_close(lab_standing_leak(&u, pneu_param_find("leak_area"), lasting, &scatter), 0, 0, 0);
  assert_true(isinf(scatter));
  lab_logs_close(&logs);
  open_loop(WITH_SP);
  assert_close(lab_standing_leak(&u, pneu_param_find("leak_area"), HUGE_VAL, &scatter), 0, 0, 0);
  lab_logs_close(&logs);
}

CASE(test_lab_standing_leak__leak_that_the_model_has__is_not_counted_again)
{
  const int gap = pneu_param_find("laminar_leak.laminar_leak");
  double scatter, seen;
  set_stairs();
  k.dead_band = 0.003;
  g.laminar_leak = 4.4e-16;
  open_loop(WITH_SP | WITH_P);
  seen = lab_standing_leak(&u, pneu_param_find("leak_area"), HUGE_VAL, &scatter);
  *pneu_param_at(&u.rig.params, gap) = (pneu_real)4.4e-16;
  assert_true(lab_standing_leak(&u, pneu_param_find("leak_area"), HUGE_VAL, &scatter) < 0.1 * seen);
  lab_logs_close(&logs);
}

CASE(test_lab_forces_begin__valve_that_leaks__spring_and_friction_as_the_pressure_moves_it)
{
  hold_within_a_wider_band();
  g.leak_area = 6e-8;
  g.dry_friction = 420;
  g.spring_preload = 0.0106;
  open_loop(WITH_SP | WITH_P);
  succeed(lab_unknowns_hold(&u, &error));
  lab_unknowns_undo_fit(&u);
  succeed(lab_forces_begin(&u, &error));
  assert_close((double)u.rig.params.spring_rate, 0.96 * 4e5, 0, 0.01);
  assert_close((double)u.rig.params.spring_preload, 0.0106, 0, 0.01);
  assert_close((double)u.rig.params.dry_friction, 420, 0, 0.05);
  assert_close((double)u.rig.params.dead_volume, 4e-5, 0, 1e-6);
  lab_logs_close(&logs);
}

CASE(test_lab_search_run__leak_at_rest__is_named_though_the_positioner_makes_up_for_it)
{
  hold_within_a_wider_band();
  g.leak_area = 6e-8;
  close_loop(WITH_SP | WITH_P);
  assert_found("chamber_leak", "chamber_leak.leak_area", 6e-8, 5e-2);
  assert_true(result.found[0].statistic > 1e4 && result.scores.n > 0);
}

CASE(test_lab_search_run__leak_through_a_gap_at_rest__is_told_from_one_through_a_hole)
{
  hold_within_a_wider_band();
  g.laminar_leak = 4.4e-16;
  close_loop(WITH_SP);
  assert_found("laminar_leak", "laminar_leak.laminar_leak", 4.4e-16, 0.1);
}

CASE(test_lab_search_run__leak_that_begins_at_rest__is_named_with_its_instant)
{
  hold_within_a_wider_band();
  leak_since = 6e-8;
  leaks_since = 22.3;
  close_loop(WITH_SP | WITH_P);
  assert_int_equal(result.verdict, LAB_VERDICT_EFFECT);
  assert_int_equal(result.n_found, 1);
  assert_string_equal(pneu_effect_at(result.found[0].effect)->name, "chamber_leak");
  assert_int_equal(u.rig.n_onsets, 1);
  assert_close(u.rig.onset[0].value, 6e-8, 0, 0.1);
  assert_close(u.rig.onset[0].from, 22.3, 0.1, 0);
}

/* Friction that rises shows at the next move; that the loop does not follow the commands on the way is no departure. */
CASE(test_lab_departure_find__friction_that_rises__is_between_the_rows)
{
  static lab_candidate c;
  size_t between[2], row;
  const double *t;
  rises_by = 600;
  leaks_since = 22.3;
  open_loop(WITH_SP | WITH_P);
  c.u = u;
  succeed(lab_candidate_hold(&c, &error));
  lab_unknowns_undo_fit(&c.u);
  succeed(lab_departure_find(&c, 0, between, &error));
  t = logs.log[0].value[LAB_CHANNEL_TIME];
  assert_between(22.3, t[between[0]] - 2, t[between[1]]);
  assert_true(between[1] < logs.log[0].n);
  succeed(lab_departure_row(&c, between[0], &row, &error));
  assert_between(row, between[0], between[1]);
  lab_logs_close(&logs);
}

/* Whether the stem of the log sticks and slips where the declared model's does not. */
static int jerks(void)
{
  size_t window;
  open_loop(WITH_SP | WITH_P);
  succeed(lab_unknowns_sticks_and_slips(&u, 1, &window, &error));
  lab_logs_close(&logs);
  return window > 0;
}

CASE(test_lab_unknowns_sticks_and_slips__friction_that_falls_with_speed__moves_the_stem_by_jerks)
{
  set_waves();
  assert_int_equal(jerks(), 0);
  g.stribeck = 1;
  g.stribeck_velocity = 2e-3;
  assert_int_equal(jerks(), 1);
}

/* ---- A value that changes within the log ---- */

/* The positioner makes up for a spring that breaks: what the travel shows of it falls out of step with a wrong size. */
CASE(test_lab_search_run__spring_that_breaks_behind_a_positioner__is_sized_and_dated_by_set_position_and_travel)
{
  const lab_rig_onset *begins = &u.rig.onset[0];
  leaks_since = 21.5;
  softens_to = 0.7;
  close_loop(WITH_SP);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_int_equal(u.rig.n_onsets, 1);
  assert_string_equal(lab_param_info(begins->param).name, "spring_rate");
  assert_close(begins->value / (double)u.rig.params.spring_rate, 0.7, 0, 0.03);
  assert_between(21.5, result.begin[0].low, result.begin[0].high);
  assert_between(result.begin[0].high - result.begin[0].low, 0, 4);
}

/* ---- Output of the positioner at every row ---- */

CASE(test_lab_search_run__opening_at_every_row__nothing_is_missing)
{
  k.cycle = spacing;
  close_loop(WITH_U | WITH_SP | WITH_P);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_close(result.after.in_noise[LAB_CHANNEL_X], 1, 0.08, 0);
}

/* Between two rows the positioner has moved on: what matters is where it jumps, with the set position. */
CASE(test_lab_search_run__opening_that_changes_between_rows__nothing_is_missing)
{
  k.cycle = 0.001;
  close_loop(WITH_U | WITH_P);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_close(result.after.in_noise[LAB_CHANNEL_X], 1, 0.08, 0);
}
