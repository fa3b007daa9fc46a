/* A line of a table as spreadsheets save it, cut into cells.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CELLS_H
#define LAB_CELLS_H

/* Cut a line into cells, in place. A cell may be in quotes, "" is a quote in it.
 * In:      mark  what stands between cells
 *          most  room in `cell`
 * Returns: how many; -1 for a quote without its end */
int lab_cells_cut(char *line, char mark, char *cell[], int most);

#endif
