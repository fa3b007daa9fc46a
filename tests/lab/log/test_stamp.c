/* apps/lab/log/stamp: dates and times of day. Day numbers are those of Python's datetime. */
#include "../../check.h"

#include "../../../apps/lab/log/stamp.h"

TEST(test_lab_stamp_read__forms_of_dates__give_day_and_second)
{
  static const struct {
    const char *text;
    int order, has_day, has_time;
    long day;
    double second;
  } good[] = {
      {"2024-03-01T12:34:56.789Z", LAB_DATE_GUESS, 1, 1, 19783, 45296.789},
      {"2024-03-01 12:34:56,789", LAB_DATE_DMY, 1, 1, 19783, 45296.789},
      {"2024-03-01T12:34:56+01:30", LAB_DATE_GUESS, 1, 1, 19783, 45296 - 5400},
      {"2024-03-01T12:34:56-0130", LAB_DATE_GUESS, 1, 1, 19783, 45296 + 5400},
      {"01.03.2024 12:34:56,5", LAB_DATE_GUESS, 1, 1, 19783, 45296.5},
      {"1.3.24", LAB_DATE_GUESS, 1, 0, 19783, 0},
      {"3/1/2024 1:02 PM", LAB_DATE_GUESS, 1, 1, 19783, 46920},
      {"3/1/2024 12:02 am", LAB_DATE_GUESS, 1, 1, 19783, 120},
      {"13/03/2024", LAB_DATE_GUESS, 1, 0, 19795, 0},
      {"01/03/2024", LAB_DATE_DMY, 1, 0, 19783, 0},
      {"01-Mar-2024 00:00:00", LAB_DATE_GUESS, 1, 1, 19783, 0},
      {"29-feb-2000", LAB_DATE_GUESS, 1, 0, 11016, 0},
      {"1999/12/31", LAB_DATE_GUESS, 1, 0, 10956, 0},
      {" 12:34:56:789 ", LAB_DATE_GUESS, 0, 1, 0, 45296.789},
      {"34:56.5", LAB_DATE_GUESS, 0, 1, 0, 2096.5},
      {"12:34", LAB_DATE_GUESS, 0, 1, 0, 45240},
  };
  size_t i;
  for (i = 0; i < sizeof good / sizeof good[0]; i++) {
    lab_stamp stamp = {0};
    check_note("%s", good[i].text);
    assert_int_equal(lab_stamp_read(good[i].text, good[i].text + strlen(good[i].text), good[i].order, &stamp), 1);
    assert_int_equal(stamp.has_day, good[i].has_day);
    assert_int_equal(stamp.has_time, good[i].has_time);
    assert_int_equal(stamp.day, good[i].day);
    assert_close(stamp.second, good[i].second, 1e-9, 0);
  }
}

TEST(test_lab_stamp_read__anything_else__is_none)
{
  static const char *const bad[] = {"",           "1.5",         "1,5",   "12",        "2024-03",   "2024-13-01",
                                    "32.01.2024", "25:00",       "12:60", "12:00:61",  "12:00 x",   "1.2.3.4",
                                    "1-2/2024",   "01-Mrz-2024", ":",     "12:00:00;", "T12:00:00", "12:34:56,7,8"};
  size_t i;
  for (i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    lab_stamp stamp = {0};
    if (lab_stamp_read(bad[i], bad[i] + strlen(bad[i]), LAB_DATE_GUESS, &stamp))
      fail_msg("\"%s\" was read", bad[i]);
  }
}
