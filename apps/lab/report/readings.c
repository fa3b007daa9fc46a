#include "readings.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double steps = 5000; /* at least, that a range is divided into */

cJSON *lab_readings_new(void)
{
  cJSON *readings = cJSON_CreateObject();
  cJSON_AddArrayToObject(readings, "columns");
  cJSON_AddObjectToObject(readings, "panels");
  return readings;
}

int lab_readings_decimals(double low, double high)
{
  const double range = high > low ? high - low : fabs(high);
  return range > 0 ? (int)fmin(fmax(ceil(log10(steps / range)), 0), 12) : 0;
}

/* "10000,3,,-2" */
static void put_differences(FILE *file, const double *value, const unsigned char *keep, size_t n, double scale)
{
  const char *comma = "";
  long long last = 0;
  size_t i;
  for (i = 0; i < n; i++) {
    if (keep && !keep[i])
      continue;
    fputs(comma, file);
    comma = ",";
    if (isfinite(value[i])) {
      const long long now = llround(scale * value[i]);
      fprintf(file, "%lld", now - last);
      last = now;
    }
  }
}

int lab_readings_column(cJSON *readings, const double *value, const unsigned char *keep, size_t n, double scale,
                        int decimals)
{
  cJSON *columns = cJSON_GetObjectItem(readings, "columns"), *column = cJSON_CreateObject();
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  if (file) {
    put_differences(file, value, keep, n, scale * pow(10, decimals));
    if (ferror(file) | fclose(file)) {
      free(text);
      text = NULL;
    }
  }
  cJSON_AddNumberToObject(column, "k", decimals);
  cJSON_AddStringToObject(column, "d", text ? text : "");
  if (!text || !cJSON_AddItemToArray(columns, column)) {
    cJSON_Delete(column);
    free(text);
    return -1;
  }
  free(text);
  return cJSON_GetArraySize(columns) - 1;
}

cJSON *lab_readings_panel(cJSON *readings, const char *figure, const lab_panel *panel, int at)
{
  cJSON *all = cJSON_GetObjectItem(readings, "panels"), *list = cJSON_GetObjectItem(all, figure);
  cJSON *item = cJSON_CreateObject();
  const double box[] = {panel->left, panel->top, panel->right, panel->bottom};
  if (!list)
    list = cJSON_AddArrayToObject(all, figure);
  cJSON_AddStringToObject(item, "group", panel->group);
  cJSON_AddStringToObject(item, "x_name", panel->x_name);
  cJSON_AddStringToObject(item, "x_unit", panel->x_unit);
  cJSON_AddStringToObject(item, "name", panel->name);
  cJSON_AddStringToObject(item, "unit", panel->unit);
  cJSON_AddItemToObject(item, "box", cJSON_CreateDoubleArray(box, 4));
  cJSON_AddItemToObject(item, "x", cJSON_CreateDoubleArray(panel->x, 2));
  cJSON_AddItemToObject(item, "y", cJSON_CreateDoubleArray(panel->y, 2));
  cJSON_AddNumberToObject(item, "at", at);
  cJSON_AddArrayToObject(item, "curves");
  if (list && cJSON_AddItemToArray(list, item))
    return item;
  cJSON_Delete(item);
  return NULL;
}

void lab_readings_curve(cJSON *panel, const char *key, int of)
{
  cJSON *list = cJSON_GetObjectItem(panel, "curves"), *item = cJSON_CreateObject();
  cJSON_AddStringToObject(item, "key", key);
  cJSON_AddNumberToObject(item, "of", of);
  if (!cJSON_AddItemToArray(list, item))
    cJSON_Delete(item);
}
