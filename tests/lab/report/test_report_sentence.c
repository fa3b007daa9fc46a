/* The answer in words. */
#include <ctype.h>

#include "../../words.h"

#include "../../../apps/lab/report/report.h"

static char text[LAB_SENTENCE_TEXT];

/* ---- Effects ---- */

/* The R1-400 with one parameter of an effect, in words. */
static const char *say(int effect, int which, double value)
{
  static char sentence[LAB_EFFECT_SENTENCE];
  lab_rig rig;
  int count;
  const int param = pneu_effect_params(effect, &count) + which;
  lab_rig_default(&rig);
  rig.laws.flow = PNEU_FLOW_CHOKED;
  *pneu_param_at(&rig.params, param) = (pneu_real)value;
  return lab_effect_sentence(&rig, effect, param, sentence);
}

TEST(test_lab_effect_sentence__each_at_its_usual_size__is_a_sentence)
{
  int e, k, count;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    pneu_effect_params(e, &count);
    for (k = 0; k < count; k++) {
      const pneu_param_info *info = &pneu_effect_at(e)->param[k];
      const char *said = info->shape ? "A 1." : say(e, k, (double)info->value);
      check_note("%s: %s", info->name, said);
      assert_true(isupper((unsigned char)*said) && said[strlen(said) - 1] == '.');
      assert_int_equal(strcspn(said, "{|}"), strlen(said));
      assert_true(said[strcspn(said, "0123456789")]);
    }
  }
  assert_null(pneu_effect_sentence(PNEU_EFFECT_COUNT));
}

/* Supply 4 bar, 25 degC, dead volume 2 mL, fill orifice 0.893 mm2, stroke 20 mm, spring 400 N/mm, 480 N of friction.
 * Choked flow is 0.0404 sqrt(K s2/m2) p/sqrt(T) per area: 0.013 mm2 x 501.3 kPa x 0.0404/sqrt(298.15 K) is 15.2
 * mg/s, 42.5 Nl/h. */
TEST(test_lab_effect_sentence__sizes__by_hand)
{
  static const struct {
    int effect;
    double value;
    const char *said;
  } cases[] = {
      {PNEU_EFFECT_chamber_leak, 1.3e-8,
       "The chamber leaks: 0.0130 mm², 1.5 % of the fill orifice, 42 Nl/h at 4 bar supply."},
      {PNEU_EFFECT_dead_time, 0.012, "Every command acts 12.0 ms late."},
      {PNEU_EFFECT_vent_restriction, 0.12, "The vent passes 12 % less than declared."},
      {PNEU_EFFECT_vent_restriction, -0.12, "The vent passes 12 % more than declared."},
      {PNEU_EFFECT_position_bias, -3e-4, "The position sensor shows 0.300 mm too little, 1.5 % of the stroke."},
      {PNEU_EFFECT_friction_pressure, 4e-4,
       "Seals rub harder under pressure: 160 N more at the supply pressure, 33 % of the dry friction."},
      {PNEU_EFFECT_spring_hardening, 5e7,
       "The spring stiffens with travel: at full stroke its force is 3.3 % off the straight line."},
      {PNEU_EFFECT_supply_droop, 1e7, "The supply gives way: it loses 10 kPa at the full flow of the fill orifice."},
      {PNEU_EFFECT_laminar_leak, 1e-16,
       "The chamber leaks through a narrow gap: 67 Nl/h at 4 bar supply, 2.3 % of what the fill orifice passes."},
      {PNEU_EFFECT_chamber_creep, 1e-7,
       "The chamber's wall gives way slowly: at the supply pressure its volume grows by 0.080 cm³, 4.0 % of the "
       "dead volume."},
      {PNEU_EFFECT_wall_temperature, 0.01, "The wall warms and cools with the gas: its heat capacity is 100 J/K."},
  };
  size_t i;
  for (i = 0; i < sizeof cases / sizeof *cases; i++)
    assert_string_equal(say(cases[i].effect, 0, cases[i].value), cases[i].said);
}

/* No friction to speak of, or none: it is no measure of 200 N. */
TEST(test_lab_effect_sentence__share_of_nothing__is_left_out)
{
  static const double friction[] = {0, 0.01};
  char sentence[LAB_EFFECT_SENTENCE];
  lab_rig rig;
  const int param = pneu_effect_params(PNEU_EFFECT_spring_hysteresis, NULL);
  int i;
  lab_rig_default(&rig);
  *pneu_param_at(&rig.params, param) = 200;
  for (i = 0; i < 2; i++) {
    rig.params.dry_friction = (pneu_real)friction[i];
    assert_string_equal(lab_effect_sentence(&rig, PNEU_EFFECT_spring_hysteresis, param, sentence),
                        "Spring and diaphragm give back less force than they took: 200 N either way.");
  }
}

/* ---- The answer ---- */

static lab_unknowns declared, completed;
static lab_search_result result;
static lab_limitations limitations;
static lab_rig rig;

/* An answer with so many effects found. */
static lab_report answer(int verdict, int n_found)
{
  static const int effects[] = {PNEU_EFFECT_dead_time, PNEU_EFFECT_pressure_gain, PNEU_EFFECT_position_lag};
  lab_report report = {.rig = &rig, .declared = &declared, .completed = &completed, .result = &result};
  int i;
  lab_rig_default(&rig);
  completed.rig = rig;
  memset(&result, 0, sizeof result);
  memset(&limitations, 0, sizeof limitations);
  report.limitations = &limitations;
  result.verdict = verdict;
  result.before.n = result.after.n = 1;
  result.before.chi2 = 9;
  result.after.chi2 = 1;
  result.n_found = n_found;
  for (i = 0; i < n_found; i++) {
    result.found[i].effect = effects[i];
    result.found[i].param = pneu_effect_params(effects[i], NULL);
    *pneu_param_at(&completed.rig.params, result.found[i].param) = (pneu_real)0.02;
  }
  return report;
}

static const char *sentence_of(const lab_report *report)
{
  lab_report_sentence(report, text);
  return text;
}

static lab_deviation deviation(const char *name, double ratio, int beyond)
{
  lab_deviation d = {.unit = "N", .declared = 100, .found = 100 * ratio, .ratio = ratio, .beyond = beyond};
  snprintf(d.name, sizeof d.name, "%s", name);
  d.param = pneu_param_find(name);
  return d;
}

TEST(test_lab_report_sentence__verdicts__what_is_missing_then_the_error)
{
  lab_report report = answer(LAB_VERDICT_EFFECT, 2);
  assert_string_equal(sentence_of(&report),
                      "Every command acts 20.0 ms late (dead_time). The pressure sensor shows 2.0 % of the reading too "
                      "much (pressure_gain). With them the error falls from 3.00 to 1.00 times the noise.");
  report = answer(LAB_VERDICT_UNDECIDED, 3);
  assert_string_equal(
      sentence_of(&report),
      "Something is missing, but the log does not say what. With the best candidates, dead_time, "
      "pressure_gain and position_lag, the error falls from 3.00 to 1.00 times the noise, as it may with "
      "others.");
  result.after.chi2 = 4;
  assert_string_equal(sentence_of(&report),
                      "Something is missing, but the log does not say what. With the best candidates, dead_time, "
                      "pressure_gain and position_lag, the error falls from 3.00 to 2.00 times the noise, but what is "
                      "left is not noise.");
  report = answer(LAB_VERDICT_UNDECIDED, 0);
  assert_string_equal(sentence_of(&report),
                      "Something is missing, but the log does not say what. The residual is 1.00 times the noise, and "
                      "nothing that was tried explains it.");
  report = answer(LAB_VERDICT_NONE, 0);
  assert_string_equal(
      sentence_of(&report),
      "Nothing is missing. The declared model leaves 1.00 times the noise, with values within their tolerances.");
  result.before = result.after;
  result.n_listed = 2;
  result.listed[0] = PNEU_EFFECT_dead_time;
  assert_string_equal(sentence_of(&report),
                      "Nothing is missing that is worth adding. The declared model leaves 1.00 times the noise. "
                      "Too small to be worth adding: dead_time and 1 more.");
  lab_limitation_no_verdict(&limitations, "The log is short.");
  assert_string_equal(sentence_of(&report), "Undecided: The log is short.");
}

/* A search that was ended does not say that something is missing where only noise is left, and says so where more is.
 */
TEST(test_lab_report_sentence__search_that_was_ended__claims_nothing)
{
  lab_report report = answer(LAB_VERDICT_UNDECIDED, 1);
  result.cut_short = 1;
  assert_string_equal(
      sentence_of(&report),
      "The search was ended by --budget before it was finished: what it has found so far may be wrong. With the best "
      "candidate, dead_time, the error falls from 3.00 to 1.00 times the noise.");
  result.n_found = 0;
  assert_contains(sentence_of(&report), "may be wrong. The residual is 1.00 times the noise.");
  report.deviations.of[report.deviations.n++] = deviation("dry_friction", 1.997, 1);
  assert_contains(sentence_of(&report), "may be wrong. As far as the log tells, friction is 2 times its sheet.");
  report.deviations.n = 0;
  result.n_found = 1; /* and takes hardly anything off */
  result.before = result.after;
  assert_contains(sentence_of(&report), "may be wrong. The residual is 1.00 times the noise.");
  result.n_found = 0;
  result.after.chi2 = 2.3;
  assert_contains(sentence_of(&report),
                  "Something is missing, and there was no time to find what. The residual is 1.52");
}

TEST(test_lab_report_limits__effects_scored_by_a_beginning__says_so)
{
  lab_report report = answer(LAB_VERDICT_EFFECT, 1);
  cJSON *list = cJSON_CreateArray();
  lab_report_limits(&report, list);
  assert_int_equal(cJSON_GetArraySize(list), 0);
  result.preview = 27.46;
  lab_report_limits(&report, list);
  assert_int_equal(cJSON_GetArraySize(list), 1);
  assert_string_equal(
      cJSON_GetArrayItem(list, 0)->valuestring,
      "Effects were scored by the first 27.5 s; what was found there was then fitted to the whole log.");
  cJSON_Delete(list);
}

TEST(test_lab_report_headline__deviations__come_first_in_the_same_line)
{
  lab_report report = answer(LAB_VERDICT_NONE, 0);
  lab_deviations *d = &report.deviations;
  d->condition = LAB_CONDITION_AS_DECLARED;
  d->of[d->n++] = deviation("dead_volume", 1.2, 0);
  lab_report_headline(&report, text);
  assert_string_equal(text, "Nothing is missing, and every declared value is within its tolerance.");
  d->condition = LAB_CONDITION_DEVIATES;
  d->of[0] = deviation("dry_friction", 3.7, 1);
  d->of[d->n++] = deviation("spring_rate", 0.75, 1);
  d->of[d->n++] = deviation("dead_volume", 1.2, 0);
  lab_report_headline(&report, text);
  assert_string_equal(text, "Friction is 3.7 times its sheet, the spring 25 % soft; nothing else is missing.");
  rig.assumed[PNEU_PARAM_dry_friction] = 1; /* no sheet says it */
  lab_report_headline(&report, text);
  assert_contains(text, "Friction is 3.7 times what was assumed, the spring 25 % soft;");
  rig.assumed[PNEU_PARAM_dry_friction] = 0;
  d->of[2] = (lab_deviation){.name = "position_gain",
                             .param = pneu_param_find("position_gain"),
                             .unit = "1",
                             .found = 0.02,
                             .ratio = NAN,
                             .beyond = 1,
                             .tolerance = 0.0025};
  lab_report_headline(&report, text); /* what the valve does comes first */
  assert_string_equal(text, "Friction is 3.7 times its sheet, the spring 25 % soft; nothing else is missing. The "
                            "position sensor shows 2.0 % of the reading too much.");
  d->of[2] = deviation("dead_volume", 1.2, 1);
  d->of[d->n++] = deviation("area", 0.4, 1);
  d->of[d->n++] = deviation("stroke", 0.95, 1);
  lab_report_headline(&report, text);
  assert_string_equal(text, "Friction is 3.7 times its sheet, the spring 25 % soft, the dead volume 20 % above its "
                            "sheet, and 2 more; nothing else is missing.");
  lab_report_evidence(&report, text); /* not of the declared model, whose values these are not */
  assert_string_equal(text, "With these values the error falls from 3.00 to 1.00 times the noise.");
  result.before.chi2 = 1;
  lab_report_evidence(&report, text);
  assert_string_equal(text, "With these values the model leaves 1.00 times the noise.");
  d->n = 1;
  d->of[0].tolerance = 1;
  lab_report_headline(&report, text);
  assert_string_equal(text, "Friction is 3.7 times what was assumed; nothing else is missing.");
  report = answer(LAB_VERDICT_EFFECT, 1);
  report.deviations.n = 1;
  report.deviations.of[0] = deviation("external_force", (double)NAN, 1);
  report.deviations.of[0].declared = 0;
  report.deviations.of[0].found = 12;
  lab_report_headline(&report, text);
  assert_string_equal(text, "The external force is 12.0 N in place of 0 N. Every command acts 20.0 ms late "
                            "(dead_time).");
  report.deviations.of[0] = deviation("vent_restriction", (double)NAN, 1);
  report.deviations.of[0].declared = 0;
  report.deviations.of[0].found = -0.06;
  lab_report_headline(&report, text);
  assert_string_equal(text, "The vent is 6 % wider. Every command acts 20.0 ms late (dead_time).");
  report.deviations.of[0].declared = 0.05; /* 0.84 of 0.95 */
  report.deviations.of[0].found = 0.16;
  report.deviations.of[0].ratio = 3.2;
  lab_report_headline(&report, text);
  assert_string_equal(text, "The vent is 12 % narrower. Every command acts 20.0 ms late (dead_time).");
  report.deviations.of[0] = deviation("spring_rate", (double)NAN, 1);
  report.deviations.of[0].declared = 0;
  lab_report_headline(&report, text);
  assert_true(strncmp(text, "The spring is ", 14) == 0 && strstr(text, " N in place of 0 N. "));
  lab_report_evidence(&report, text); /* which not one of the two alone has done */
  assert_string_equal(text, "With all of this the error falls from 3.00 to 1.00 times the noise.");
}

/* Beside something that is missing, values are what makes up for it as well as it can. */
TEST(test_lab_report_headline__undecided__tells_values_last_and_with_care)
{
  lab_report report = answer(LAB_VERDICT_UNDECIDED, 0);
  lab_deviations *d = &report.deviations;
  result.cut_short = 0;
  result.after.chi2 = 9 * (double)result.after.n;
  lab_report_headline(&report, text);
  assert_string_equal(text, "Something is missing, but the log does not say what.");
  d->of[d->n++] = deviation("dry_friction", 1.997, 1);
  d->of[d->n++] = deviation("spring_rate", 0.75, 1);
  lab_report_headline(&report, text);
  assert_string_equal(text,
                      "Something is missing, but the log does not say what. As far as the log tells, friction is 2 "
                      "times its sheet, the spring 25 % soft.");
  d->of[1] = (lab_deviation){
      .name = "position_gain", .param = pneu_param_find("position_gain"), .unit = "1", .found = 0.02, .beyond = 1};
  lab_report_headline(&report, text);
  assert_contains(text, "friction is 2 times its sheet. The position sensor shows 2.0 % of the reading too much.");
  result.n_found = 1; /* as the best candidate it is told elsewhere */
  result.found[0] = (lab_found){.effect = pneu_effect_find("position_gain"), .param = d->of[1].param};
  lab_report_headline(&report, text);
  assert_null(strstr(text, "too much"));
  result.is_far = 1;
  d->n = 1;
  lab_report_sentence(&report, text);
  assert_contains(text, "It takes values far off their sheet to explain the log: the sheet is of another rig, or "
                        "something else is missing. As far as the log tells, friction is 2 times its sheet.");
  assert_null(strstr(text, "is not noise"));
  result.is_far = 0;
  result.jerks = 1;
  d->n = 0;
  lab_report_headline(&report, text);
  assert_contains(text, "The stem moves by jerks and the model's does not: something is missing, perhaps friction");
  result.jerks = 0;
  result.sound_until = 120.4;
  lab_report_headline(&report, text);
  assert_contains(text, "Until 120.4 s nothing is missing; then something is, but the log does not say what.");
}

/* A value that changes within the log is told, though it stays within its tolerance. */
TEST(test_lab_report_headline__value_that_changes__is_told_within_its_tolerance)
{
  lab_report report = answer(LAB_VERDICT_NONE, 0);
  report.deviations.condition = LAB_CONDITION_AS_DECLARED;
  report.deviations.n = 1;
  report.deviations.of[0] = deviation("dry_friction", 1.22, 0);
  report.deviations.of[0].param = PNEU_PARAM_dry_friction;
  completed.n = 1;
  completed.unknown[0].kind = LAB_UNKNOWN_ONSET;
  completed.rig.n_onsets = 1;
  completed.rig.onset[0] = (lab_rig_onset){PNEU_PARAM_dry_friction, 22.5, 122};
  result.begin[0] = (lab_onset){1, 22.5, 21.2, 23.4};
  lab_report_headline(&report, text);
  assert_string_equal(text, "Friction is 22 % above its sheet since 22.5 s (21.2 to 23.4 s); nothing else is missing.");
  assert_int_equal(lab_report_count_told(&report), 1);
  completed.n = 0;
  assert_int_equal(lab_report_count_told(&report), 0);
}

/* Values and effects since the baseline are told as those of today are. */
TEST(test_lab_report_headline__since_the_baseline__is_told_in_the_same_words)
{
  static lab_changes changes;
  lab_report report = answer(LAB_VERDICT_NONE, 0);
  lab_rig_default(&completed.rig);
  completed.rig.laws.flow = PNEU_FLOW_CHOKED;
  report.changes = &changes;
  changes.condition = LAB_SINCE_CHANGED;
  changes.n = 4;
  changes.change[0] = (lab_change){.param = PNEU_PARAM_dry_friction, .then = 480, .now = 720};
  changes.change[1] = (lab_change){.param = pneu_param_find("leak_area"), .now = 1.3e-8, .begin = {1, 14.2, 14, 15}};
  changes.change[2] = (lab_change){.param = pneu_param_find("dead_time.dead_time"), .then = 0.01, .now = 0.012};
  changes.change[3] = (lab_change){.param = pneu_param_find("transducer_time"), .then = 0.2};
  lab_report_headline(&report, text);
  assert_contains(
      text,
      "Changed since the baseline: friction from 480 N to 720 N (1.50 times); the chamber leaks: 0.0130 mm²,"
      " 1.5 % of the fill orifice, 42 Nl/h at 4 bar supply (chamber_leak) since 14.2 s (14.0 to 15.0 s); every command"
      " acts 12.0 ms late (dead_time, 1.20 times what it was); no longer: the transducer follows its command"
      " with a lag of 200 ms (transducer_lag). ");
  changes.n = 2;
  changes.change[0] = (lab_change){.param = pneu_param_find("positioner.dead_band"), .then = 0.005, .now = 0.008};
  changes.change[1] = (lab_change){.param = PNEU_PARAM_spring_rate, .then = 4e5, .now = 3e5};
  lab_report_headline(&report, text);
  assert_contains(text,
                  "baseline: the positioner dead band from 0.00500 to 0.00800 (1.60 times); the rate of the spring"
                  " from 400 N/mm to 300 N/mm (0.750 times). ");
  changes.n = 1; /* of what was hardly there it is no multiple */
  changes.change[0] = (lab_change){.param = pneu_param_find("vent_restriction"), .then = -0.003, .now = 0.3};
  lab_report_headline(&report, text);
  assert_contains(text, "the vent passes 30 % less than declared (vent_restriction). ");
  changes.change[0].then = 0.027;
  lab_report_headline(&report, text);
  assert_contains(text, "declared (vent_restriction, 2.7 % before). ");
  changes.change[0] = (lab_change){.param = pneu_param_find("position_bias"), .then = -1.4e-4, .now = 1.56e-3};
  lab_report_headline(&report, text);
  assert_contains(text, " (position_bias, -0.140 mm before). ");
}

/* What has changed is not told again as what is missing. */
TEST(test_lab_report_headline__found_and_changed__is_told_once)
{
  static lab_changes changes = {.condition = LAB_SINCE_CHANGED, .n = 1};
  const int leak = pneu_param_find("leak_area");
  lab_report report = answer(LAB_VERDICT_EFFECT, 0);
  lab_rig_default(&completed.rig);
  completed.rig.laws.flow = PNEU_FLOW_CHOKED;
  result.n_found = 1;
  result.found[0] = (lab_found){.effect = pneu_effect_of(leak), .param = leak};
  changes.change[0] = (lab_change){.param = leak, .now = 1.3e-8};
  report.changes = &changes;
  lab_report_headline(&report, text);
  assert_string_equal(text, "Changed since the baseline: the chamber leaks: 0.0130 mm², 1.5 % of the fill orifice, 42"
                            " Nl/h at 4 bar supply (chamber_leak). ");
  changes.change[0].param = pneu_param_find("transducer_time");
  lab_report_headline(&report, text);
  assert_contains(text, "The chamber leaks");
}

/* What to look at on the rig stands beside effects that there are. */
TEST(test_inspect_def__each_line__is_of_an_effect)
{
  static const char *const names[] = {
#define X(effect, text) #effect,
#include "../../../apps/lab/report/inspect.def"
#undef X
  };
  size_t i;
  for (i = 0; i < sizeof names / sizeof *names; i++) {
    check_note("%s", names[i]);
    assert_true(pneu_effect_find(names[i]) >= 0);
  }
  assert_int_equal(i, PNEU_EFFECT_COUNT - 1); /* the positioner is declared, and none of what is found */
}

/* Of many cycles the best is tried: page and report.json tell the chance over all of them. */
TEST(test_lab_report_chance__cycle__counts_what_was_looked_at)
{
  lab_report report = answer(LAB_VERDICT_UNLISTED, 0);
  const lab_found free_term = {.effect = -1, .term = 0, .statistic = 40, .degrees = 3};
  const lab_found effect = {.effect = 0, .p_value = 0.25};
  double once;
  completed.rig.n_terms = 1;
  completed.rig.term[0].argument = PNEU_TERM_OVER_POSITION;
  once = lab_report_chance(&report, &free_term);
  assert_true(once > 0 && once < 1e-6);
  completed.rig.term[0].argument = PNEU_TERM_OVER_CYCLE;
  assert_close(lab_report_chance(&report, &free_term), 1000 * once, 0, 1e-12);
  assert_true(lab_report_chance(&report, &effect) == 0.25);
}

/* ---- Since when ---- */

TEST(test_lab_report_since__interval__gives_its_digits)
{
  const lab_onset sharp = {1, 12.3006, 12.29, 12.31}, blunt = {1, 9.42, 9.31, 11.25}, late = {1, 3620.4, 3601, 3655};
  char since[LAB_SINCE_TEXT];
  assert_string_equal(lab_report_since(&sharp, since), " since 12.30 s (12.29 to 12.31 s)");
  assert_string_equal(lab_report_since(&blunt, since), " since 9.42 s (9.31 to 11.2 s)");
  assert_string_equal(lab_report_since(&late, since), " since 3620 s (3600 to 3660 s)");
  assert_string_equal(lab_report_since(NULL, since), "");
}
