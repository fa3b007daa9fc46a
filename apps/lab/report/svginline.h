/* An SVG that gnuplot drew, as part of a page.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SVGINLINE_H
#define LAB_SVGINLINE_H

/* The drawing as a page takes it up:
 * - no XML declaration, name spaces, background and empty groups;
 * - colours of study/figures/style.gp as variables of the page's style, --f-blue and so on, so that it can be dark;
 * - a curve whose title is one word in small letters, "before", is a group of the class c-before; other titles go;
 * - every other id, and each reference to it, is preceded by `name`, so that several drawings live in one page.
 * In:      svg   as gnuplot's svg terminal writes it
 *          name  letters
 *          alt   what the drawing shows, in words
 *          head  height to cut off at the top
 * Returns: text to be freed; NULL if it is no SVG, or without memory. */
char *lab_svg_inline(const char *svg, const char *name, const char *alt, int head);

#endif
