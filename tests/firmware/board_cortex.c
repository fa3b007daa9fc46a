/* Start and services of a Cortex-M0 to M4F under QEMU: no library but the compiler's.
 *
 * Text leaves by semihosting (Arm, "Semihosting for AArch32 and AArch64"). Time is the emulator's instruction count
 * (-icount shift=6): an instruction takes 64 ns, and SysTick runs at BOARD_CLOCK. */
#include <stdint.h>

#include "board.h"

#ifndef BOARD_CLOCK
#error "BOARD_CLOCK: frequency of SysTick [Hz]"
#endif

enum { SYS_WRITE0 = 4, SYS_EXIT = 0x18, STOPPED_BY_ERROR = 0x20023, STOPPED_BY_EXIT = 0x20026 };
enum { HALF_NS_PER_INSTRUCTION = 128, HALF_NS_PER_TICK = 2000000000 / BOARD_CLOCK };
enum { TICK_MASK = 0xffffff, PAINT = 0x5a5a5a5a };

#define SYSTICK_CONTROL (*(volatile uint32_t *)0xe000e010)
#define SYSTICK_RELOAD  (*(volatile uint32_t *)0xe000e014)
#define SYSTICK_VALUE   (*(volatile uint32_t *)0xe000e018)
#define FPU_ACCESS      (*(volatile uint32_t *)0xe000ed88)

extern uint32_t board_data_from[], board_data_to[], board_data_end[], board_bss[], board_bss_end[];
extern uint32_t board_stack_low[], board_stack_top[];

int main(void);
void board_reset(void);
void board_fault(void);

static uint32_t *painted_to;

static uintptr_t host(uintptr_t operation, uintptr_t argument)
{
  register uintptr_t r0 __asm__("r0") = operation;
  register uintptr_t r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

void board_text(const char *text)
{
  host(SYS_WRITE0, (uintptr_t)text);
}

void board_number(long value)
{
  char digits[12], *at = digits + sizeof digits - 1;
  unsigned long rest = value < 0 ? -(unsigned long)value : (unsigned long)value;
  *at = 0;
  do {
    *--at = (char)('0' + rest % 10);
    rest /= 10;
  } while (rest);
  if (value < 0)
    *--at = '-';
  board_text(at);
}

unsigned long board_ticks(void)
{
  return SYSTICK_VALUE;
}

long board_instructions(unsigned long from, unsigned long to)
{
  const unsigned long ticks = (from - to) & TICK_MASK; /* it counts down */
  return (long)((ticks * HALF_NS_PER_TICK + HALF_NS_PER_INSTRUCTION / 2) / HALF_NS_PER_INSTRUCTION);
}

void board_paint_stack(void)
{
  uint32_t *at, *here;
  __asm__ volatile("mov %0, sp" : "=r"(here));
  for (at = board_stack_low; at < here; at++)
    *(volatile uint32_t *)at = PAINT; /* not by memset, which would need stack itself */
  painted_to = here;
}

long board_stack_used(void)
{
  uint32_t *at = board_stack_low;
  while (*at == PAINT)
    at++;
  return (long)((char *)painted_to - (char *)at);
}

void board_fault(void)
{
  board_text("fault\n");
  host(SYS_EXIT, STOPPED_BY_ERROR);
  for (;;)
    ;
}

void board_reset(void)
{
  uint32_t *from = board_data_from, *to;
#ifdef __ARM_FP
  FPU_ACCESS |= 0xf << 20;
  __asm__ volatile("dsb\n\tisb" ::: "memory");
#endif
  for (to = board_data_to; to < board_data_end; to++)
    *to = *from++;
  for (to = board_bss; to < board_bss_end; to++)
    *to = 0;
  SYSTICK_RELOAD = TICK_MASK;
  SYSTICK_VALUE = 0;
  SYSTICK_CONTROL = 5; /* on, by the processor's clock, no interrupt */
  host(SYS_EXIT, main() == 0 ? STOPPED_BY_EXIT : STOPPED_BY_ERROR);
  for (;;)
    ;
}

__attribute__((section(".vectors"), used)) static const struct {
  uint32_t *stack;
  void (*handler[15])(void);
} vectors = {board_stack_top, {board_reset, board_fault, board_fault, board_fault, board_fault, board_fault}};
