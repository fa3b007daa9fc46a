/* apps/study/report: REPORT.md from tables made up here */
#include "../scratch.h"

#include "../../apps/study/products.h"

/* Tables of no interest here. */
static const char *const empty[][2] = {
    {"paper_numbers.csv", "item,quantity,unit,printed,computed,agrees,note,kind,cause,statement,severity,counted\n"},
    {"eq1.csv", "actuator,gas,flow,stroke,lag_T_s,lag_rms,ramp_T_s,ramp_rms,shape\n"},
    {"hypotheses_thresholds.csv", "actuator,hypothesis,gas,flow,share_left,share_left_signed,share_alone,"
                                  "share_alone_signed,depends_on_threshold\n"},
    {"directions.csv", "actuator,gas,flow,what,down_over_up,duration_ratio,asymmetry,asymmetry_signed\n"},
    {"influence.csv", "actuator,hypothesis,gas,flow,asymmetry_min,asymmetry_max\n"},
    {"conclusions_actuators.csv", "conclusion,actuator,set,gas,flow,value,low,high,verdict,evidence\n"},
    {"conclusions_thresholds.csv", "conclusion,set,gas,flow,verdict,at_5,at_10,at_20,at_30,at_41,depends_on\n"},
    {"agreement.csv", "actuator,gas,flow,position_gap_over_stroke,pressure_gap_over_supply,mass_gap,energy_gap\n"}};

static study *made_up(void)
{
  static study s;
  memset(&s, 0, sizeof s);
  snprintf(s.results, sizeof s.results, "%s", scratch_folder);
  s.n_actuators = 2;
  s.n_printed = 1;
  strcpy(s.actuator[0].name, "one");
  strcpy(s.actuator[1].name, "one-bench");
  s.confirmed_below = 0.1;
  return &s;
}

static char *text; /* of the last report */

/* The report where one table has rows, and the others none: `text` then. */
static void report_with(const char *name, const char *rows)
{
  size_t i;
  for (i = 0; i < sizeof empty / sizeof *empty; i++)
    if (!scratch_exists(scratch_path(empty[i][0])))
      scratch_text(empty[i][0], empty[i][1]);
  scratch_text(name, rows);
  succeed(report_make(made_up(), &error));
  free(text);
  text = scratch_read(scratch_path("REPORT.md"));
}

static const char *const numbers =
    "item,quantity,unit,printed,computed,agrees,note,kind,cause,statement,severity,counted\n"
    "a1,q,1,5,5,yes,n,,,Eq. 1,,yes\n"
    "a2,q,1,5,6,no,n,data,a slip,Eq. 1,number,yes\n"
    "b,q,1,,2,rounding,n,,,Eq. 2,,yes\n"
    "b2,q,1,,2,yes,n,,,Eq. 2,,yes\n"
    "c,q,1,7,8,no,n,data,a slip,Eq. 3,number,yes\n"
    "d,q,1,7,9,no,n,data,a slip,Eq. 3,number,yes\n"
    "e,q,1,3,4,no,n,,,,,no\n"
    "f,q,1,,1,no,n,modelling,a gap,Eq. 4,conclusion,yes\n"
    "g,q,1,,1,no,n,arithmetic,a sign,Eq. 5,form,yes\n";

/* Eq. 1 disagrees in one of its rows, 7 is printed once and tried twice, e is an aside. */
TEST(test_report__rows_of_one_statement__counted_once)
{
  report_with("paper_numbers.csv", numbers);
  assert_contains(text, "Of 5 ");
  assert_contains(text, " 1 are ");
  assert_contains(text, "\n\n4 are not, 2 numbers");
  assert_contains(text, "None turns with a threshold");
}

TEST(test_report__three_causes__each_once_by_what_it_changes)
{
  report_with("paper_numbers.csv", numbers);
  assert_contains(text, "|\n| a gap | modelling | Eq. 4 | |\n\n"
                        "A number: a slip (data; 5 printed, 6 computed).\n"
                        "Matters of form: a sign.\n");
}

TEST(test_report__laws_that_differ__counted_and_marked)
{
  scratch_text("conclusions_actuators.csv", "conclusion,actuator,set,gas,flow,value,low,high,verdict,evidence\n"
                                            "1,one,printed,isothermal,paper,1,,1,holds,e\n"
                                            "1,one,printed,isothermal,choked,1,,1,contradicted,e\n"
                                            "1,one-bench,bench,isothermal,paper,1,,1,contradicted,e\n"
                                            "2,one,printed,isothermal,paper,1,,1,holds when it rains,e\n"
                                            "2,one,printed,isothermal,choked,1,,1,holds when it snows,e\n");
  report_with("conclusions_thresholds.csv", "conclusion,set,gas,flow,verdict,at_5,at_10,at_20,at_30,at_41,depends_on\n"
                                            "1,printed,isothermal,paper,holds,,,,,,set\n"
                                            "1,printed,isothermal,choked,contradicted,,,,,,\"threshold, set\"\n"
                                            "2,printed,isothermal,paper,holds when,,,,,,\n");
  assert_contains(text, "| the paper concludes | one | depends on | remark |");
  assert_contains(text, "| holds (1 of 2), contradicted (1 of 2) | threshold, set |");
  assert_contains(text, "| holds when | |");
}

/* 2 has a mark, 3 fails in one law. */
TEST(test_report__conclusions_that_hold_throughout__in_words)
{
  scratch_text("conclusions_actuators.csv", "conclusion,actuator,set,gas,flow,value,low,high,verdict,evidence\n"
                                            "1,one,printed,isothermal,paper,1,,1,contradicted,e\n"
                                            "2,one,printed,isothermal,paper,1,,1,holds,e\n"
                                            "3,one,printed,isothermal,paper,1,,1,holds,e\n"
                                            "3,one,printed,isothermal,choked,1,,1,contradicted,e\n"
                                            "11,one,printed,isothermal,paper,1,,1,holds,e\n"
                                            "11,one,printed,isothermal,choked,1,,1,holds,e\n");
  report_with("conclusions_thresholds.csv", "conclusion,set,gas,flow,verdict,at_5,at_10,at_20,at_30,at_41,depends_on\n"
                                            "2,printed,isothermal,paper,holds,,,,,,threshold\n");
  assert_contains(
      text, "these hold:\n\n11 fall: theoretical change free of parameters (as the theoretical change; over their "
            "travels the actuators differ).\n");
  assert_contains(text, "\n| 1 | ");
  assert_contains(text, "\n| 2 | ");
  assert_contains(text, "\n| 3 | ");
  assert_null(strstr(text, "\n| 11 | "));
}

/* 20 % is left in one law, 5 % in the other: two verdicts; the other actuator is the same in both. */
TEST(test_report__hypothesis_that_differs_by_law__is_marked)
{
  report_with("hypotheses_thresholds.csv", "actuator,hypothesis,gas,flow,share_left,share_left_signed,"
                                           "share_alone,share_alone_signed,depends_on_threshold\n"
                                           "one,H2,a,b,0.2,0.2,,,yes\none,H2,a,c,0.05,-0.05,,,no\n"
                                           "one-bench,H2,a,b,1.5,1.5,,,no\n");
  assert_contains(text, "| H2 preload of the spring | not confirmed | -5..20 %: differs by law † | 150 %: not "
                        "confirmed |");
  assert_contains(text, "† turns with a threshold");
}

TEST(test_report__no_table__data_error)
{
  remove(scratch_path("conclusions_thresholds.csv"));
  assert_fails(report_make(made_up(), &error), LAB_DATA, "conclusions_thresholds.csv");
}
