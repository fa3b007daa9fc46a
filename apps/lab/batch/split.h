/* Lists in one text: "a.csv;b.csv".
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SPLIT_H
#define LAB_SPLIT_H

/* Cut a text at a mark; blanks around the parts and empty parts are dropped.
 * In/out:  text  cut in place
 * Out:     part  point into it
 * Returns: how many; -1 if there are more than `room`. */
int lab_split(char *text, char mark, const char **part, int room);

/* Drop blanks in front and behind, in place.  Returns: where the rest begins */
char *lab_trim(char *text);

#endif
