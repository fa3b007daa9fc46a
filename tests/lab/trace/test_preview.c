/* What the beginning of a log of the independent rig says of the whole. */
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/trace/preview.h"

enum { ROWS = 1401 };

static lab_rig rig;
static lab_log log_read;
static lab_run run;
static lab_unknowns u;
static lab_finding found, before;

/* Search 14 s of a rig that is another from some time on by its first 4.9 s.  Returns: whether that was enough */
static int preview(const second_rig *first, const second_rig *later, double change)
{
  static const lab_finding none;
  lab_search_options options;
  int done;
  virtual_record(first, later, change, scratch_path("log.csv"));
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  rig.fit[rig.n_fit++] = pneu_param_find("spring_rate");
  virtual_open(&rig, scratch_path("log.csv"), &log_read, &run);
  succeed(lab_unknowns_open(&rig, &run, 1, &u, &error));
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error));
  lab_search_options_default(&options);
  found = none;
  succeed(lab_search_measure(&u, LAB_STAGE_BEFORE, &found.result, &error));
  before = found;
  succeed(lab_preview_search(&u, &options, &found, &done, &error));
  return done;
}

/* The answer is one of the whole run, and as close to it as noise lets it. */
static void assert_whole(void)
{
  assert_ptr_equal(found.best.u.run, &run);
  assert_int_equal((int)found.best.quality.values, 2 * ROWS);
  assert_true(lab_is_noise(&found.best.quality));
}

TEST(test_lab_preview_search__leak__is_that_of_the_whole_run)
{
  second_rig g = virtual_rig(5);
  g.leak_area = 2e-8;
  assert_true(preview(&g, NULL, 0));
  assert_whole();
  assert_int_equal(found.result.verdict, LAB_VERDICT_EFFECT);
  assert_string_equal(pneu_effect_at(found.best.found[0].effect)->name, "chamber_leak");
  assert_close(*pneu_param_at(&found.best.u.rig.params, pneu_param_find("leak_area")), 2e-8, 0, 0.05);
  assert_close(found.result.preview, 4.89, 0, 1e-6);
  assert_int_equal(found.result.n_path, 2);
  assert_true(found.result.path[0].chi2 > 10 * found.result.path[1].chi2);
}

TEST(test_lab_preview_search__nothing_is_missing__finds_nothing)
{
  const second_rig g = virtual_rig(6);
  assert_true(preview(&g, NULL, 0));
  assert_whole();
  assert_int_equal(found.result.verdict, LAB_VERDICT_NONE);
  assert_int_equal(found.best.n_found, 0);
  assert_true(found.result.preview == 0 && found.result.scores.n > 0);
  assert_int_equal(found.result.n_path, 1);
}

/* After what was seen of it: the values of the beginning tell when the run leaves them, and by what. */
TEST(test_lab_preview_search__spring_that_breaks_later__is_found_from_there)
{
  const second_rig first = virtual_rig(7);
  second_rig later = first;
  later.spring_rate *= 0.7;
  assert_true(preview(&first, &later, 8.57));
  assert_whole();
  assert_int_equal(found.result.verdict, LAB_VERDICT_NONE);
  assert_int_equal(found.best.u.rig.n_onsets, 1);
  assert_int_equal(found.best.u.rig.onset[0].param, pneu_param_find("spring_rate"));
  assert_close(found.best.u.rig.onset[0].value, later.spring_rate, 0, 0.02);
  assert_between(8.57, found.best.begin[0].low, found.best.begin[0].high);
}

/* What it has seen is until when the run is as declared. */
TEST(test_lab_preview_search__much_that_begins_later__is_left_to_the_search_of_the_whole)
{
  const second_rig first = virtual_rig(7);
  second_rig later = first;
  later.spring_rate *= 0.7;
  later.dry_friction *= 4;
  later.leak_area = 2e-7;
  assert_false(preview(&first, &later, 8.57));
  assert_between(found.result.sound_until, 8.3, 8.7);
  found.result.sound_until = 0;
  assert_memory_equal(&found, &before, sizeof found);
}

TEST(test_lab_preview_is_asked__short_or_several_or_coarse__no)
{
  static lab_log log;
  lab_run of_rows = {.n = 3000, .log = &log};
  lab_unknowns of_run = {.run = &of_rows, .n_runs = 1};
  assert_true(lab_preview_is_asked(&of_run));
  of_rows.n = 2999;
  assert_false(lab_preview_is_asked(&of_run));
  of_rows.n_instants = 1; /* costs as much as rows do */
  assert_true(lab_preview_is_asked(&of_run));
  of_rows.n = 399;
  of_rows.n_instants = 1000; /* but their beginning would tell nothing */
  assert_false(lab_preview_is_asked(&of_run));
  of_rows.n = 3000;
  of_run.n_runs = 2;
  assert_false(lab_preview_is_asked(&of_run));
  of_run.n_runs = 1;
  of_run.window = 50;
  assert_false(lab_preview_is_asked(&of_run));
}
