/* What a residual shows of the noise: memory, where the rig is at rest, and not where a set position moves it. */
#include "../../fixture.h"
#include "../../scratch.h"

#include "../../../apps/lab/fit/weights.h"

enum { ROWS = 400 };

static lab_rig rig;
static lab_log one_log;
static lab_run run;
static lab_unknowns u;
static uint64_t seed;

/* A valve whose travel scatters with a memory of 0.8 from row to row; the set position stays, or is the same. */
static void write_log(int follows)
{
  FILE *file = fopen(scratch_path("log.csv"), "w");
  double wander = 0; /* [mm] */
  int i;
  assert_non_null(file);
  fprintf(file, "t [s],sp [mm],x [mm]\n");
  seed = 7;
  for (i = 0; i < ROWS; i++) {
    wander = 0.8 * wander + 0.3 * fixture_normal(&seed);
    fprintf(file, "%d,%.4f,%.4f\n", i, 10 + (follows ? wander : 0), 10 + wander + 0.05 * fixture_normal(&seed));
  }
  fclose(file);
}

/* A model of which orifices let through this share.  In: noise [m] of the travel */
static void open_with(double share, double noise)
{
  lab_rig_default(&rig);
  rig.params.fill_area *= (pneu_real)share;
  rig.params.vent_area *= (pneu_real)share;
  rig.noise[LAB_CHANNEL_X] = noise;
  fixture_set(&rig.params, "positioner.gain", 20);
  rig.fit[rig.n_fit++] = pneu_param_find("positioner.gain");
  succeed(lab_log_read(scratch_path("log.csv"), &rig.log, 101325, &one_log, &error));
  succeed(lab_run_open(&rig, &one_log, 0, &run, &error));
  succeed(lab_unknowns_open(&rig, &run, 1, &u, &error));
}

/* Next to nothing: its stem stays where it is. */
static void open_stuck(double noise)
{
  open_with(1e-6, noise);
}

static double memory_told(int follows, double noise)
{
  double memory;
  int any;
  write_log(follows);
  open_stuck(noise);
  succeed(lab_weigh_runs(&u, &run, &any, &error));
  memory = run.colour[0].memory;
  lab_run_close(&run);
  lab_log_free(&one_log);
  return memory;
}

TEST(test_lab_weigh_runs__set_position_stays__noise_has_memory)
{
  assert_between(memory_told(0, 2e-4), 0.6, 0.9);
}

TEST(test_lab_weigh_runs__set_position_moves__is_no_noise)
{
  assert_close(memory_told(1, 2e-4), 0, 0, 0);
}

TEST(test_lab_weigh_runs__clock_that_is_declared__counts_as_it_is)
{
  int any;
  write_log(0);
  open_stuck(3e-4);
  rig.noise[LAB_CHANNEL_TIME] = 0.05;
  succeed(lab_weigh_runs(&u, &run, &any, &error));
  assert_true(any);
  assert_close(run.jitter, 0.05, 0, 0);
  succeed(lab_weigh_runs(&u, &run, &any, &error));
  assert_close(run.jitter, 0.05, 0, 0);
  lab_run_close(&run);
  lab_log_free(&one_log);
}

/* What a poor model left may have been taken for memory: that it is none is as much news as that it is one. */
TEST(test_lab_weigh_runs__memory_that_is_none_after_all__is_news_once)
{
  int any, again;
  double plain, sigma;
  write_log(1);
  open_stuck(2e-4);
  succeed(lab_weigh_runs(&u, &run, &any, &error));
  plain = run.sigma[0];
  lab_run_close(&run);
  lab_log_free(&one_log);
  open_stuck(2e-4);
  run.colour[0].memory = run.colour[0].share = 0.3;
  run.sigma[0] *= 1.5;
  run.raised[0] = 1.5;
  succeed(lab_weigh_runs(&u, &run, &any, &error));
  assert_close(run.colour[0].memory, 0, 0, 0);
  assert_close(run.raised[0], 0, 0, 0);
  succeed(lab_weigh_runs(&u, &run, &again, &error));
  sigma = run.sigma[0];
  lab_run_close(&run);
  lab_log_free(&one_log);
  assert_true(any && !again);
  assert_close(sigma, plain, 0, 1e-12);
}

/* The travel wanders by 0.5 mm. */
TEST(test_lab_weigh_runs__wanders_by_tens_of_the_declared__is_no_noise)
{
  assert_close(memory_told(0, 2e-5), 0, 0, 0);
  assert_between(memory_told(0, 1e-4), 0.6, 0.9);
}

/* Rows far between, of which noise was taken for ten times what it is; a declared one stays. */
TEST(test_lab_weigh_runs__noise_taken_for_too_much__is_what_is_left)
{
  FILE *file = fopen(scratch_path("log.csv"), "w");
  double told;
  int i, any;
  assert_non_null(file);
  fprintf(file, "t [s],sp [mm],x [mm]\n");
  seed = 7;
  for (i = 0; i < ROWS; i++)
    fprintf(file, "%d,10,%.4f\n", i, 10 + 0.05 * fixture_normal(&seed));
  fclose(file);
  for (told = 0; told < 2; told++) {
    open_stuck(told > 0 ? 5e-4 : (double)NAN);
    run.sigma[0] = 5e-4;
    succeed(lab_weigh_runs(&u, &run, &any, &error));
    assert_close(run.sigma[0], told > 0 ? 5e-4 : 5e-5, told > 0 ? 0 : 5e-6, 0);
    lab_run_close(&run);
    lab_log_free(&one_log);
  }
}

/* A stem that follows a set position which walks by 1 mm a row, and errors of 0.5 mm with this memory beside it.
 * Returns: what counts as noise [m] */
static double noise_of_walk(double memory)
{
  FILE *file = fopen(scratch_path("log.csv"), "w");
  double set = 10, wander = 0, sigma;
  int i, any;
  assert_non_null(file);
  fprintf(file, "t [s],sp [mm],x [mm]\n");
  seed = 7;
  for (i = 0; i < ROWS; i++) {
    const double next = fmin(fmax(set + fixture_normal(&seed), 4), 16);
    wander = memory * wander + 0.5 * sqrt(1 - memory * memory) * fixture_normal(&seed);
    fprintf(file, "%d,%.4f,%.4f\n", i, next, set + wander);
    set = next;
  }
  fclose(file);
  open_with(1, (double)NAN);
  succeed(lab_weigh_runs(&u, &run, &any, &error));
  sigma = run.sigma[0];
  lab_run_close(&run);
  lab_log_free(&one_log);
  return sigma;
}

/* Nothing stands still: what goes on from row to row is the model's error, of which 0.1 mm, 0.5 % of the stroke, may be
 * noise; what does not is noise. */
TEST(test_lab_weigh_runs__all_moves__errors_that_go_on_are_not_noise)
{
  assert_close(noise_of_walk(0.97), 1e-4, 0, 1e-9);
  assert_between(noise_of_walk(0), 4e-4, 8e-4);
}
