/* Ctrl-C between files, not within one: a program that is asked to end does so at once, but for the short time in which
 * it puts files in their place or waits for a child; then it ends just after. It ends by the signal itself, so that a
 * shell sees 130 for Ctrl-C. A second signal is not put off.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_INTERRUPT_H
#define LAB_INTERRUPT_H

/* Take charge of SIGINT, SIGTERM and SIGHUP, but for those that the parent had ignored (nohup). Without this call the
 * other two do nothing. */
void lab_interrupt_catch(void);

/* End this process when it has used so much CPU time, with a message and the status LAB_WORLD.
 * In:      seconds  at least 1
 * Returns: 0 if the system does not take it */
int lab_interrupt_after(const char *program, int seconds);

/* Put off a signal until as many calls of release as of hold; from any thread. */
void lab_interrupt_hold(void);
void lab_interrupt_release(void);

/* Whether a signal waits.  Returns: its number, or 0 */
int lab_interrupt_pending(void);

#endif
