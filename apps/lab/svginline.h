/* An SVG that gnuplot drew, as part of a page.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SVGINLINE_H
#define LAB_SVGINLINE_H

/* The drawing without what only a file needs: no XML declaration and name spaces, no titles that a mouse would bring
 * up, every id and reference to one preceded by `name`, so that several drawings live in one page.
 * In:      svg   as gnuplot's svg terminal writes it
 *          name  letters
 *          alt   what the drawing shows, in words
 * Returns: text to be freed; NULL if it is no SVG, or without memory. */
char *lab_svg_inline(const char *svg, const char *name, const char *alt);

#endif
