/* The board of a program that runs on a computer. */
#include <stdio.h>

#include "board.h"

void board_text(const char *text)
{
  fputs(text, stdout);
}

void board_number(long value)
{
  printf("%ld", value);
}

unsigned long board_ticks(void)
{
  return 0;
}

long board_instructions(unsigned long from, unsigned long to)
{
  (void)from, (void)to;
  return 0;
}

void board_paint_stack(void)
{
}

long board_stack_used(void)
{
  return 0;
}
