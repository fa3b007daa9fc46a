/* Commands that act late: in runs and in steps, and the line in which they wait. */
#include "../fixture.h"

enum { SLOTS = 32 };

/* A command line with room, and all that a loop needs. */
typedef struct loop {
  pneu_model model;
  pneu_late slot[SLOTS];
  pneu_delay line;
  pneu_input input;
  pneu_state state;
  pneu_workspace work;
} loop;

/* At rest under a command that has been acting; without dead time, or positioner, for 0. */
static void begin_behind(loop *l, double gain, double dead_time, int room, double u)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  p.fill_area = p.vent_area = (pneu_real)4e-6;
  if (gain > 0)
    fixture_set(&p, "gain", gain);
  if (dead_time > 0)
    fixture_set(&p, "dead_time", dead_time);
  memset(l, 0, sizeof *l);
  l->model = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  pneu_delay_begin(&l->line, l->slot, room, (pneu_real)u);
  l->input = fixture_input(&l->model, u);
  l->input.delay = &l->line;
  l->state = fixture_rest(&l->model, 0, 0, &l->input);
}

static void begin(loop *l, double dead_time, int room, double u)
{
  begin_behind(l, 0, dead_time, room, u);
}

static int run(loop *l, double u, double duration)
{
  const pneu_options options = fixture_options(TOL(1e-9, 1e-5));
  l->input.u = (pneu_real)u;
  return pneu_run(&l->model, &l->state, &l->input, (pneu_real)duration, &options, NULL, &l->work);
}

static int step(loop *l, double u, double dt)
{
  l->input.u = (pneu_real)u;
  return pneu_step(&l->model, &l->state, &l->input, (pneu_real)dt, &l->work);
}

static void assert_alike(const loop *a, const loop *b, double p, double x)
{
  assert_close(a->state.p, b->state.p, p, 0);
  assert_close(a->state.x, b->state.x, x, 0);
}

TEST(test_pneu_run_and_step__dead_time_without_a_line__are_refused_and_change_nothing)
{
  loop l;
  pneu_state before;
  fixture_need("dead_time");
  begin(&l, 0.02, SLOTS, 0);
  l.input.delay = NULL;
  before = l.state;
  assert_int_equal(run(&l, 1, 0.1), PNEU_E_DELAY);
  assert_int_equal(step(&l, 1, 1e-3), PNEU_E_DELAY);
  assert_memory_equal(&l.state, &before, sizeof before);
}

TEST(test_pneu_run_and_step__line_without_dead_time__change_not_a_bit)
{
  loop a, b;
  int i;
  begin(&a, 0, SLOTS, 0);
  begin(&b, 0, SLOTS, 0);
  b.input.delay = NULL;
  for (i = 0; i < 40; i++) {
    const double u = i % 10 < 5 ? 1 : -0.5;
    assert_int_equal(i % 2 ? run(&a, u, 0.05) : step(&a, u, 2e-3), PNEU_OK);
    assert_int_equal(i % 2 ? run(&b, u, 0.05) : step(&b, u, 2e-3), PNEU_OK);
    assert_memory_equal(&a.state, &b.state, sizeof a.state);
  }
  assert_int_equal(a.line.n, 0);
}

/* Three commands, the second shorter than the dead time: as a prompt model does that gets each one later. */
TEST(test_pneu_run__dead_time__is_that_of_a_prompt_model_with_late_commands)
{
  static const double u[] = {1, -1, 0.5}, duration[] = {0.5, 0.03, 1.0};
  loop late, prompt;
  int i;
  fixture_need("dead_time");
  begin(&late, 0.0415, SLOTS, 0);
  begin(&prompt, 0, SLOTS, 0);
  for (i = 0; i < COUNT(u); i++)
    assert_int_equal(run(&late, u[i], duration[i]), PNEU_OK);
  assert_int_equal(run(&prompt, 0, 0.0415), PNEU_OK);
  for (i = 0; i < COUNT(u); i++)
    assert_int_equal(run(&prompt, u[i], duration[i] - (i == 2 ? 0.0415 : 0)), PNEU_OK);
  assert_alike(&late, &prompt, TOL(0.1, 200), TOL(1e-9, 1e-5));
  assert_int_equal(late.line.n, 0);
}

/* Past a positioner the line delays an opening as without one; a set position needs no line. */
TEST(test_pneu_run__dead_time_beside_a_positioner__is_the_lines_only_for_openings)
{
  loop beside, alone;
  fixture_need("dead_time");
  fixture_need("positioner");
  begin_behind(&beside, 20, 0.0415, SLOTS, 0);
  begin(&alone, 0.0415, SLOTS, 0);
  assert_int_equal(run(&beside, 1, 0.06), PNEU_OK);
  assert_int_equal(run(&alone, 1, 0.06), PNEU_OK);
  assert_true(alone.state.p > 1000);
  assert_alike(&beside, &alone, TOL(0.1, 200), TOL(1e-9, 1e-5));
  beside.input.set_position = 1;
  beside.input.delay = NULL;
  assert_int_equal(run(&beside, 0.5, 0.1), PNEU_OK);
}

/* A loop of 1 kHz whose dead time ends within a step, against runs; what reads off a state sees the command that acts.
 */
TEST(test_pneu_step__dead_time__commands_act_to_the_instant)
{
  const double dead_time = 0.0205;
  loop late, prompt;
  pneu_output out;
  int i;
  fixture_need("dead_time");
  begin(&late, dead_time, SLOTS, 0);
  begin(&prompt, 0, SLOTS, 0);
  for (i = 0; i < 300; i++) {
    assert_int_equal(step(&late, i < 200 ? 1 : -1, 1e-3), PNEU_OK);
    assert_int_equal(pneu_observe(&late.model, &late.state, &late.input, &out), PNEU_OK);
    assert_close(out.opening, i < 20 ? 0 : i < 220 ? 1 : -1, 0, 0);
    if (i == 19) /* 0.5 ms before it acts */
      assert_close(late.state.p, 0, TOL(1e-6, 0.1), 0);
  }
  assert_int_equal(run(&prompt, 1, 0.2), PNEU_OK);
  assert_int_equal(run(&prompt, -1, 0.1 - dead_time), PNEU_OK);
  assert_alike(&late, &prompt, TOL(200, 400), TOL(1e-6, 2e-6));
}

/* Too many changes within the dead time: said, and neither state nor line is another. With the room that is documented
 * there are never too many. */
TEST(test_pneu_step__no_room_for_a_command__says_so_and_changes_nothing)
{
  loop l, before;
  int i;
  fixture_need("dead_time");
  begin(&l, 0.02, 5, 0);
  for (i = 0; i < 5; i++)
    assert_int_equal(step(&l, 0.1 * (i + 1), 1e-3), PNEU_OK);
  before = l;
  assert_int_equal(step(&l, 0.7, 1e-3), PNEU_E_DELAY);
  assert_int_equal(run(&l, 0.7, 1e-3), PNEU_E_DELAY);
  assert_memory_equal(&l.state, &before.state, sizeof l.state);
  assert_memory_equal(&l.line, &before.line, sizeof l.line);
  assert_int_equal(step(&l, 0.5, 0.05), PNEU_OK); /* the same command needs no room, and then there is room again */
  assert_int_equal(step(&l, 0.7, 1e-3), PNEU_OK);
  begin(&l, 0.02, 21, 0);
  for (i = 0; i < 500; i++)
    assert_int_equal(step(&l, i % 2 ? 0.5 : 1, 1e-3), PNEU_OK);
}

/* ---- The line alone ---- */

/* A million changes, one in each millisecond: each acts after the delay, in single precision too. */
TEST(test_pneu_delay__many_changes__no_time_is_lost)
{
  enum { TURNS = 1000000, BEHIND = 20 };
  pneu_late slot[SLOTS];
  pneu_delay d;
  int i;
  pneu_delay_begin(&d, slot, SLOTS, 0);
  for (i = 1; i <= TURNS; i++) {
    assert_int_equal(pneu_delay_give(&d, (pneu_real)0.0205, (pneu_real)i), PNEU_OK);
    pneu_delay_pass(&d, (pneu_real)1e-3);
    pneu_delay_release(&d);
  }
  assert_close(d.acting, TURNS - BEHIND, 0, 0);
  assert_close(pneu_delay_until(&d, 1), 0.5e-3, TOL(1e-12, 1e-7), 0);
}

/* A length that changes does not change the order. */
TEST(test_pneu_delay_give__shorter_than_before__keeps_the_order)
{
  pneu_late slot[SLOTS];
  pneu_delay d;
  pneu_delay_begin(&d, slot, SLOTS, 0);
  assert_int_equal(pneu_delay_give(&d, (pneu_real)0.5, 1), PNEU_OK);
  assert_int_equal(pneu_delay_give(&d, (pneu_real)0.1, 2), PNEU_OK);
  assert_close(pneu_delay_until(&d, 9), 0.5, 0, TOL(1e-15, 1e-7));
  pneu_delay_pass(&d, (pneu_real)0.5);
  pneu_delay_release(&d);
  assert_close(d.acting, 2, 0, 0);
}

/* A signal that rests, runs and jumps, looked at late: as a recorder shows a position. */
static double wanted(double t)
{
  return t < 0.1 ? 1 : t < 0.3 ? 1 + 10 * (t - 0.1) : t < 0.4 ? 3 : 5;
}

static void check_followed(double length, double dt)
{
  pneu_late slot[SLOTS];
  pneu_delay d;
  double t = 0;
  pneu_delay_begin(&d, slot, SLOTS, 1);
  while (t < 0.8) {
    const double next = t + dt;
    double ahead;
    if (fabs(t - 0.4) < 1e-6)
      assert_int_equal(pneu_delay_give(&d, (pneu_real)length, 5), PNEU_OK);
    assert_int_equal(
        pneu_delay_follow(&d, (pneu_real)length, (pneu_real)dt, (pneu_real)(t > 0.4 - 1e-6 ? 5 : wanted(next - 1e-12))),
        PNEU_OK);
    pneu_delay_release(&d);
    t = next;
    for (ahead = 0; ahead < fmin(length, (double)pneu_delay_until(&d, 1)) - 1e-3; ahead += 0.004) {
      check_note("delay %g, %g ahead of %g", length, ahead, t);
      if (fabs(t + ahead - length - 0.4) > 1e-3)
        assert_close(pneu_delay_value(&d, (pneu_real)ahead), wanted(t + ahead - length), TOL(1e-9, 2e-4), 0);
    }
  }
  assert_close(pneu_delay_value(&d, 0), 5, 0, 0);
}

TEST(test_pneu_delay_follow__running_signal__is_interpolated)
{
  check_followed(0.11, 0.02);
  check_followed(0.033, 0.02);
  check_followed(0.005, 0.02);
}

TEST(test_pneu_delay_follow__no_room__says_so)
{
  pneu_late slot[2];
  pneu_delay d;
  pneu_delay_begin(&d, slot, 2, 0);
  assert_int_equal(pneu_delay_follow(&d, 1, (pneu_real)0.1, 1), PNEU_OK); /* held, and then ran */
  assert_int_equal(pneu_delay_follow(&d, 1, (pneu_real)0.1, 2), PNEU_E_DELAY);
}
