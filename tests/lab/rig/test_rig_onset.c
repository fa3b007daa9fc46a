/* What begins within a log, in a rig file. */
#include "../../rigfile.h"

static const char two[] =
    "onset = ( { parameter = \"chamber_leak.leak_area\"; from = \"40.2 s\"; value = \"0.02 mm^2\"; },\n"
    "          { parameter = \"orifice_area\"; from = \"2 min\"; value = 0.6; } );\n";

static double leak_of(lab_rig rig)
{
  return (double)*pneu_param_at(&rig.params, pneu_param_find("leak_area"));
}

TEST(test_lab_rig_at__onsets__act_from_their_times_on)
{
  const lab_rig rig = read_rig(two);
  const double fill = (double)rig.params.fill_area;
  lab_rig now;
  assert_int_equal(rig.n_onsets, 2);
  lab_rig_at(&rig, 40.1, &now);
  assert_close(leak_of(now), 0, 0, 0);
  assert_int_equal(now.n_onsets, 0);
  lab_rig_at(&rig, 40.2, &now);
  assert_close(leak_of(now), 2e-8, 0, 1e-12);
  assert_close(now.params.fill_area, fill, 0, 0);
  lab_rig_at(&rig, INFINITY, &now);
  assert_close(leak_of(now), 2e-8, 0, 1e-12);
  assert_close(now.params.fill_area, 0.6 * fill, 0, 1e-12);
}

TEST(test_lab_rig_write__onsets__come_back_bit_for_bit)
{
  const lab_rig rig = read_rig(two), again = write_and_read(&rig, NULL);
  int i;
  assert_int_equal(again.n_onsets, 2);
  for (i = 0; i < 2; i++) {
    assert_int_equal(again.onset[i].param, rig.onset[i].param);
    assert_close(again.onset[i].from, rig.onset[i].from, 0, 0);
    assert_close(again.onset[i].value, rig.onset[i].value, 0, 0);
  }
}

TEST(test_lab_rig_read__onset_that_is_wrong__is_refused)
{
  assert_rig_refused("onset = ( { parameter = \"dry_friction\"; from = 3; } );", "onset", "value is missing");
  assert_rig_refused("onset = ( { parameter = \"dry_fricton\"; from = 3; value = 4; } );", "onset", "dry_friction");
  assert_rig_refused("onset = ( { parameter = \"dry_friction\"; from = \"3 m\"; value = 4; } );", "onset", "onset");
  assert_rig_refused("onset = ( { parameter = \"dry_friction\"; from = 3; value = \"-4 N\"; } );", "onset", "value");
  assert_rig_refused("onset = ( { parameter = \"dry_friction\"; from = 3; value = 4; },\n"
                     "          { parameter = \"dry_friction\"; from = 2; value = 4; } );",
                     "onset", "no earlier time");
  assert_rig_refused("onset = ( { parameter = \"dry_friction\"; since = 3; value = 4; } );", "onset", "unknown key");
}
