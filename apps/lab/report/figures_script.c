/* What all figures share: words, and pieces of a script. */
#include <ctype.h>
#include <stdarg.h>
#include <string.h>

#include "figures_private.h"

const double figure_right_edge = 0.975, figure_two_sided_99 = 2.5758293035489004;

/* Scripts are carried, a line a string. */
static const char *const style_gp[] = {
#include "study/figures/style.gp.inc"
    NULL};
static const char *const panels_gp[] = {
#include "apps/lab/report/page/panels.gp.inc"
    NULL};

/* ---- Text ---- */

const char *figure_plain(const char *name, char text[LAB_SHOWN_TEXT])
{
  size_t i;
  for (i = 0; name[i] && i + 1 < LAB_SHOWN_TEXT; i++)
    text[i] = (char)(isalnum((unsigned char)name[i]) ? name[i] : ' ');
  text[i] = '\0';
  return text;
}

const char *figure_quantity_name(int channel, char text[LAB_SHOWN_TEXT])
{
  figure_plain(lab_channels[channel].quantity, text);
  text[0] = (char)toupper((unsigned char)text[0]);
  return text;
}

const char *figure_channel_name(int channel, char text[LAB_SHOWN_TEXT])
{
  figure_quantity_name(channel, text);
  strncat(text, " ", LAB_SHOWN_TEXT - strlen(text) - 1);
  strncat(text, lab_channels[channel].key, LAB_SHOWN_TEXT - strlen(text) - 1);
  return text;
}

const char *figure_unit_or_1(const char *unit)
{
  return *unit ? unit : "1";
}

int figure_has_completed(const drawing *d)
{
  return d->story->result->n_found > 0;
}

void figure_tell(const drawing *d, const char *format, ...)
{
  const size_t used = strlen(d->figure->alt);
  va_list list;
  va_start(list, format);
  vsnprintf(d->figure->alt + used, LAB_FIGURE_ALT - used, format, list);
  va_end(list);
}

void figure_entitle(const drawing *d, const char *title)
{
  snprintf(d->figure->title, LAB_FIGURE_TEXT, "%s", title);
}

int figure_stages(const drawing *d)
{
  return figure_has_completed(d) ? LAB_STAGE_COUNT : 1;
}

const char *figure_stage_name(int stage)
{
  return stage == LAB_STAGE_BEFORE ? "declared" : "completed";
}

/* ---- Pieces of a script ---- */

void figure_put_lines(FILE *file, const char *const *line)
{
  for (; *line; line++)
    fputs(*line, file);
}

void figure_put_head(const drawing *d, int height, int head, const char *subtitle)
{
  snprintf(d->figure->subtitle, LAB_FIGURE_TEXT, "%s", subtitle);
  d->figure->head = head;
  fprintf(d->file, "reset\nNAME = \"%s\"\nHEIGHT = %d\nTITLE = \"%s\"\nSUBTITLE = \"%s\"\n", d->figure->name, height,
          d->figure->title, subtitle);
  figure_put_lines(d->file, style_gp);
  figure_put_lines(d->file, panels_gp);
  fprintf(d->file, "FOUND = %d\n", figure_has_completed(d));
}

void figure_put_box(const drawing *d, int number, lab_panel *panel, double top, double height)
{
  panel->top = top;
  panel->bottom = top + height;
  fprintf(d->file, "TOP[%d] = %g\nBOTTOM[%d] = %g\n", number, panel->top, number, panel->bottom);
}

void figure_put_sides(const drawing *d, int number, lab_panel *panel, double left, double right)
{
  panel->left = FIGURE_WIDTH * left;
  panel->right = FIGURE_WIDTH * right;
  fprintf(d->file, "LEFT[%d] = %g\nRIGHT[%d] = %g\n", number, left, number, right);
}

double figure_side(int i, int n)
{
  static const double left = 0.075, right = 0.985;
  return left + (right - left) / n * i;
}
