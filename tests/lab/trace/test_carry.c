/* Three logs of the independent rig: a leak that all of them have carries over, one of a single log does not. */
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/trace/carry.h"
#include "../../../apps/lab/trace/rivals.h"

enum { LOGS = 3 };
static const double leak = 0.02; /* of the vent orifice */

static lab_rig rig;
static lab_log logs[LOGS];
static lab_run run[LOGS];
static lab_candidate c;

/* n logs, some with a leak, and a leak found beside the declared model. Where all leak, a stiffer spring leaves more
 * than noise. */
static void open_logs(const int leaks[LOGS], int n)
{
  int e;
  lab_found *found;
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = pneu_param_find("dry_friction");
  for (e = 0; e < n; e++) {
    const char *path = scratch_path("one.csv");
    second_rig g = virtual_rig((uint64_t)(3 + e));
    g.spring_rate *= leaks[0] ? 1.02 : 1;
    g.leak_area = leaks[e] ? leak * g.vent_area : 0;
    virtual_record_brief(&g, path);
    virtual_open(&rig, path, &logs[e], &run[e]);
  }
  memset(&c, 0, sizeof c);
  succeed(lab_unknowns_open(&rig, run, n, &c.u, &error));
  found = lab_candidate_add_found(&c);
  found->effect = pneu_effect_find("chamber_leak");
  found->param = pneu_param_find("chamber_leak.leak_area");
  found->term = -1;
  succeed(lab_unknowns_add(&c.u, found->param, 1e-8, &error));
  lab_unknowns_view(&c.u, 0);
  succeed(lab_candidate_fit(&c, LAB_ROUNDS_ALL, &error));
  assert_false(lab_is_noise(&c.quality));
}

static int is_pruned(const int leaks[LOGS], int n)
{
  int any;
  open_logs(leaks, n);
  succeed(lab_carry_prune(&c, &any, &error));
  assert_int_equal(any, c.n_found == 0);
  assert_int_equal(c.u.n_runs, n);
  return any;
}

TEST(test_lab_carry_prune__leak_of_all_logs__stays)
{
  assert_false(is_pruned((const int[LOGS]){1, 1, 1}, LOGS));
}

TEST(test_lab_carry_prune__leak_of_one_log__is_taken_out)
{
  assert_true(is_pruned((const int[LOGS]){0, 1, 0}, LOGS));
}

/* Of two logs one is all that is left to fit. */
TEST(test_lab_carry_prune__two_logs__are_not_asked)
{
  assert_false(is_pruned((const int[LOGS]){0, 1}, 2));
}

static double carried(void)
{
  double of_run[LOGS], sum = 0;
  int e;
  succeed(lab_carry_over(&c, of_run, &error));
  for (e = 0; e < c.u.n_runs; e++)
    sum += of_run[e];
  return sum;
}

/* A run left out has no part in the fit: what it errs by is what a fit to the others alone predicts of it. */
TEST(test_lab_carry_over__runs_of_one_rig__err_as_fits_to_the_others_do)
{
  double sum, of_two;
  open_logs((const int[LOGS]){1, 1, 1}, LOGS);
  sum = carried();
  succeed(lab_unknowns_chi2(&c.u, &of_two, &error));
  assert_between(sum / of_two, 0.9, 1.2);
  c.u.n_runs = 2;
  lab_unknowns_view(&c.u, 0);
  assert_between(carried() / sum, 0.6, 0.72);
}

/* One standard error: of differences 1, 1, 1 none; of 3, 0, 0 as much as their mean; what cannot be followed is worse.
 */
TEST(test_lab_carry_is_better__differences_of_runs__are_held_against_their_scatter)
{
  static const double present[] = {10, 20, 30};
  assert_true(lab_carry_is_better((const double[]){9, 19, 29}, present, 3));
  assert_false(lab_carry_is_better((const double[]){7.1, 20, 30.1}, present, 3));
  assert_true(lab_carry_is_better((const double[]){7.1, 19.9, 30}, present, 3));
  assert_false(lab_carry_is_better((const double[]){11, 21, 31}, present, 3));
  assert_false(lab_carry_is_better((const double[]){(double)INFINITY, 0, 0}, present, 3));
  assert_true(lab_carry_is_better(present, (const double[]){(double)INFINITY, 0, 0}, 3));
}

/* Where more than noise is left, a lower BIC is no reason: that of a laminar leak is lower, by 73, and it carries over
 * worse, by 9 %. */
TEST(test_lab_rivals_try__three_logs__keeps_what_carries_over)
{
  int changed;
  open_logs((const int[LOGS]){0, 1, 1}, LOGS);
  succeed(lab_rivals_try(&c, &changed, &error));
  assert_false(changed);
  assert_string_equal(pneu_effect_at(c.found[0].effect)->name, "chamber_leak");
}
