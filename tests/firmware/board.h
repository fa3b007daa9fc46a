/* What the firmware programs need of the board they run on: a way to say something, an end, and a counter.
 * board_cortex.c is for a Cortex-M under an emulator, board_host.c for a computer with an operating system.
 * SPDX-License-Identifier: MIT */
#ifndef FIRMWARE_BOARD_H
#define FIRMWARE_BOARD_H

void board_text(const char *text);
void board_number(long value);

/* Instructions since the start, modulo 2^24 ticks of the counter; 0 where there is no counter. */
unsigned long board_ticks(void);

/* Instructions between two readings. */
long board_instructions(unsigned long from, unsigned long to);

/* Bytes of stack that have been used at most since board_paint_stack(), below its caller; 0 where it cannot be told. */
void board_paint_stack(void);
long board_stack_used(void);

#endif
