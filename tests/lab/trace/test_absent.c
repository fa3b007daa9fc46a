/* A declared leak that a log of the independent rig refutes, or has. */
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/trace/absent.h"

static lab_rig rig;
static lab_log run_log;
static lab_run run;
static lab_candidate c;
static lab_fit_result fit;

/* A fit of the declared leak, and the friction, to a log.  In: leak  of the rig, over its vent orifice */
static void open_log(double leak)
{
  const char *path = scratch_path("one.csv");
  const int at = pneu_param_find("chamber_leak.leak_area");
  second_rig g = virtual_rig(3);
  virtual_declare(&rig);
  *pneu_param_at(&rig.params, at) = (pneu_real)(0.02 * g.vent_area);
  rig.fit[rig.n_fit++] = pneu_param_find("dry_friction");
  rig.fit[rig.n_fit++] = at;
  g.leak_area = leak * g.vent_area;
  virtual_record_brief(&g, path);
  virtual_open(&rig, path, &run_log, &run);
  memset(&c, 0, sizeof c);
  succeed(lab_unknowns_open(&rig, &run, 1, &c.u, &error));
  lab_unknowns_view(&c.u, 0);
  succeed(lab_candidate_fit(&c, LAB_ROUNDS_ALL, &error));
}

static const lab_unknown *leak_of(void)
{
  return &c.u.unknown[lab_unknowns_find(&c.u, pneu_param_find("chamber_leak.leak_area"))];
}

/* It rests at 0, costs nothing of BIC, and its interval says how large it may be. */
TEST(test_lab_absent_find__leak_that_is_not_there__rests)
{
  const double largest = 1e-3; /* of the vent orifice */
  double bic;
  int any, j;
  open_log(0);
  bic = c.quality.bic;
  assert_false(lab_unknown_rests(leak_of()));
  succeed(lab_absent_find(&c, &any, &error));
  assert_true(any && lab_unknown_is_absent(leak_of()));
  assert_true(c.quality.bic <= bic);
  assert_true(leak_of()->value == 0);
  succeed(lab_unknowns_intervals(&c.u, &fit, &error));
  j = lab_unknowns_find(&c.u, pneu_param_find("chamber_leak.leak_area"));
  assert_close(fit.low[j], 0, 0, 0);
  assert_between(fit.high[j], 1e-15, largest * (double)rig.params.vent_area);
  assert_true(lab_unknown_rests(leak_of()));
}

TEST(test_lab_absent_find__leak_that_is_there__stays)
{
  int any;
  open_log(0.01);
  succeed(lab_absent_find(&c, &any, &error));
  assert_false(any || lab_unknown_rests(leak_of()));
  assert_close(leak_of()->value, 0.01 * (double)rig.params.vent_area, 0, 0.05);
}
