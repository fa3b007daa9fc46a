/* apps/lab/base/csv: lines and cells of CSV files */
#include "../../scratch.h"

#include "../../../apps/lab/base/csv.h"

static lab_csv csv;

static void open_text(const char *text)
{
  succeed(lab_csv_open(&csv, scratch_text("t.csv", text), &error));
}

/* The next row, which must be there and whole. */
static void next_row(int cells)
{
  int more;
  succeed(lab_csv_line(&csv, &more, &error));
  assert_true(more);
  succeed(lab_csv_cut(&csv, &error));
  assert_int_equal(csv.n, cells);
}

static void assert_cell(int i, const char *text)
{
  assert_string_equal(csv.cell[i].begin, text);
  assert_true(csv.cell[i].end == csv.cell[i].begin + strlen(text));
}

static void assert_no_more(void)
{
  int more;
  succeed(lab_csv_line(&csv, &more, &error));
  assert_false(more);
}

TEST(test_lab_csv_cut__cells__are_as_rfc_4180_says)
{
  static const struct {
    const char *line;
    char mark;
    int n;
    const char *cell[3];
  } row[] = {
      {"a,b,c", ',', 3, {"a", "b", "c"}},
      {"", ',', 1, {""}},
      {",", ',', 2, {"", ""}},
      {" a , b", ',', 2, {" a ", " b"}},
      {"\"a,b\",\"\",c", ',', 3, {"a,b", "", "c"}},
      {"\"say \"\"hi\"\"\",\"\"\"\"", ',', 2, {"say \"hi\"", "\""}},
      {" \"a;b\" ; c\"d\";\"e\"f", ';', 3, {"a;b ", " c\"d\"", "ef"}},
      {"a\t \"b\tc\"", '\t', 2, {"a", "b\tc"}},
      {"a  \"b c\"", ' ', 3, {"a", "", "b c"}},
  };
  size_t i;
  for (i = 0; i < sizeof row / sizeof *row; i++) {
    char text[100];
    int k;
    check_note("row %d", (int)i);
    snprintf(text, sizeof text, "%s\nnext\n", row[i].line);
    open_text(text);
    csv.mark = row[i].mark;
    next_row(row[i].n);
    for (k = 0; k < row[i].n; k++)
      assert_cell(k, row[i].cell[k]);
    next_row(1);
    assert_cell(0, "next");
    lab_csv_close(&csv);
  }
}

TEST(test_lab_csv_cut__quote_that_does_not_end__is_refused_with_its_line)
{
  static const char *const bad[] = {"\"b\nc\"\n", "x,\"b\"\"\n", "\"", " \"b"};
  size_t i;
  int more;
  for (i = 0; i < sizeof bad / sizeof *bad; i++) {
    char text[100];
    snprintf(text, sizeof text, "a\n%s", bad[i]);
    open_text(text);
    next_row(1);
    succeed(lab_csv_line(&csv, &more, &error));
    assert_int_equal(lab_csv_cut(&csv, &error), LAB_DATA);
    assert_fails(lab_csv_fail_in(&csv, &error), LAB_DATA, "t.csv:2: a quote");
    lab_csv_close(&csv);
  }
}

TEST(test_lab_csv_line__comments_and_ends_of_lines__count_as_lines)
{
  open_text("\xEF\xBB\xBF# one\r\na,b\r\n#\n\n # c");
  csv.comment = '#';
  assert_int_equal(lab_csv_lines(&csv), 5);
  next_row(2);
  assert_int_equal(csv.line, 2);
  assert_cell(1, "b");
  next_row(1);
  assert_int_equal(csv.line, 4);
  assert_cell(0, "");
  next_row(1);
  assert_int_equal(csv.line, 5);
  assert_cell(0, " # c");
  assert_no_more();
  lab_csv_close(&csv);
}

TEST(test_lab_csv_restart__rows_that_were_cut__come_again)
{
  int i;
  open_text("\"a,\"\"\",b\nc,d\n");
  for (i = 0; i < 2; i++) {
    next_row(2);
    assert_int_equal(csv.line, 1);
    assert_cell(0, "a,\"");
    next_row(2);
    assert_cell(1, "d");
    assert_no_more();
    lab_csv_restart(&csv);
  }
  lab_csv_close(&csv);
}

TEST(test_lab_csv_is_over__blank_lines_to_the_end__are_nothing)
{
  int more;
  open_text("\na\n \n\t\r\n");
  succeed(lab_csv_line(&csv, &more, &error));
  assert_false(lab_csv_is_over(&csv));
  next_row(1);
  assert_false(lab_csv_is_over(&csv));
  succeed(lab_csv_line(&csv, &more, &error));
  assert_true(lab_csv_is_over(&csv));
  lab_csv_close(&csv);
}

TEST(test_lab_csv_cut__many_cells__are_counted)
{
  char text[3 * LAB_CSV_CELLS] = "y";
  int i;
  for (i = 0; i <= LAB_CSV_CELLS; i++)
    strcat(text, ",y");
  open_text(text);
  next_row(LAB_CSV_CELLS + 2);
  assert_cell(LAB_CSV_CELLS - 1, "y");
  lab_csv_close(&csv);
}

TEST(test_lab_csv_line__as_long_as_may_be_and_longer__is_told_apart)
{
  char *text = malloc(LAB_CSV_LINE + 4);
  int more;
  assert_non_null(text);
  memset(text, '7', LAB_CSV_LINE + 2);
  memcpy(text + LAB_CSV_LINE, "\r\n", 3);
  open_text(text);
  next_row(1);
  assert_int_equal(csv.cell[0].end - csv.cell[0].begin, LAB_CSV_LINE);
  lab_csv_close(&csv);
  memcpy(text + LAB_CSV_LINE, "7\r\n", 4);
  open_text(text);
  assert_fails(lab_csv_line(&csv, &more, &error), LAB_DATA,
               "t.csv:1: expected a line of at most 65536 bytes, found 65537");
  lab_csv_close(&csv);
  free(text);
}
