#include "numbers.h"

#include "paper.h"

static const struct {
  const char *file;
  void (*fill)(table *t);
} closed[] = {{"fig05.csv", paper_fig05},
              {"fig06.csv", paper_fig06},
              {"fig07.csv", paper_fig07},
              {"fig08.csv", paper_fig08},
              {"paper_numbers.csv", paper_numbers_table}};

int numbers_make(const study *s, lab_error *error)
{
  size_t i;
  int status = LAB_OK;
  for (i = 0; i < sizeof closed / sizeof *closed && status == LAB_OK; i++) {
    table t;
    closed[i].fill(&t);
    status = study_save(s, closed[i].file, &t, error);
    table_close(&t);
  }
  return status;
}
