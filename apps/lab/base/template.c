#include "template.h"

#include <stdlib.h>
#include <string.h>

#include "escape.h"
#include "outfile.h"
#include "text.h"

/* Objects from the innermost outwards. */
typedef struct scope {
  const cJSON *value;
  const struct scope *outer;
} scope;

/* A tag: {{kind name}}, between begin and end. */
typedef struct tag {
  const char *begin, *end;
  const char *name;
  int length;
  char kind; /* '#', '^', '/', '{' as it stands, ' ' escaped */
} tag;

/* The next tag.  Returns: 1; 0 if there is none; -1 if it is not closed. */
static int next_tag(const char *from, const char *to, tag *t)
{
  const char *close;
  size_t extra;
  t->begin = strstr(from, "{{");
  if (!t->begin || t->begin >= to)
    return 0;
  t->name = t->begin + 2;
  t->kind = ' ';
  if (strchr("#^/{", *t->name))
    t->kind = *t->name++;
  close = strstr(t->name, t->kind == '{' ? "}}}" : "}}");
  if (!close || close >= to)
    return -1;
  extra = t->kind == '{' ? 3 : 2;
  t->length = (int)(close - t->name);
  t->end = close + extra;
  if (strchr("#^/", t->kind) && *t->end == '\n')
    t->end++;
  return 1;
}

/* The tag that closes a section.  Returns: 0 if there is none. */
static int closing_tag(const tag *open, const char *to, tag *t)
{
  int depth = 1;
  t->end = open->end;
  while (depth > 0) {
    if (next_tag(t->end, to, t) != 1)
      return 0;
    depth += t->kind == '/' ? -1 : t->kind == '#' || t->kind == '^';
  }
  return t->length == open->length && !strncmp(t->name, open->name, (size_t)t->length);
}

static const cJSON *look_up(const tag *t, const scope *inner)
{
  char name[64];
  if (t->length == 1 && *t->name == '.')
    return inner->value;
  snprintf(name, sizeof name, "%.*s", t->length, t->name);
  for (; inner; inner = inner->outer) {
    const cJSON *found = cJSON_GetObjectItemCaseSensitive(inner->value, name);
    if (found)
      return found;
  }
  return NULL;
}

static int is_there(const cJSON *value)
{
  return cJSON_IsString(value) ? *value->valuestring != '\0'
                               : cJSON_IsObject(value) || cJSON_IsTrue(value) || cJSON_GetArraySize(value) > 0;
}

static int fill(FILE *file, const char *from, const char *to, const scope *inner, lab_error *error);

static int fill_section(FILE *file, const tag *open, const tag *close, const scope *inner, lab_error *error)
{
  const cJSON *value = look_up(open, inner), *item;
  if (is_there(value) == (open->kind == '^'))
    return LAB_OK;
  if (cJSON_IsObject(value)) {
    const scope here = {value, inner};
    return fill(file, open->end, close->begin, &here, error);
  }
  if (open->kind == '^' || !cJSON_IsArray(value))
    return fill(file, open->end, close->begin, inner, error);
  cJSON_ArrayForEach(item, value)
  {
    const scope here = {item, inner};
    if (fill(file, open->end, close->begin, &here, error))
      return error->status;
  }
  return LAB_OK;
}

static void fill_text(FILE *file, const tag *t, const scope *inner)
{
  const cJSON *value = look_up(t, inner);
  if (!cJSON_IsString(value))
    return;
  if (t->kind == '{')
    fputs(value->valuestring, file);
  else
    lab_put_html(file, value->valuestring);
}

static int fill(FILE *file, const char *from, const char *to, const scope *inner, lab_error *error)
{
  tag t, close;
  int more;
  while ((more = next_tag(from, to, &t)) == 1) {
    fwrite(from, 1, (size_t)(t.begin - from), file);
    from = t.end;
    if (t.kind == ' ' || t.kind == '{') {
      fill_text(file, &t, inner);
      continue;
    }
    if (t.kind == '/' || !closing_tag(&t, to, &close))
      return lab_fail(error, LAB_DATA, "template: {{%c%.*s}} has no partner", t.kind, t.length, t.name);
    if (fill_section(file, &t, &close, inner, error))
      return error->status;
    from = close.end;
  }
  if (more < 0)
    return lab_fail(error, LAB_DATA, "template: a tag is not closed: %.20s", t.begin);
  fwrite(from, 1, (size_t)(to - from), file);
  return LAB_OK;
}

int lab_template_write(FILE *file, const char *template, const cJSON *values, lab_error *error)
{
  const scope all = {values, NULL};
  return fill(file, template, template + strlen(template), &all, error);
}

char *lab_template_text(const char *const *piece)
{
  lab_writing w;
  for (lab_writing_begin(&w); w.file && *piece; piece++)
    fputs(*piece, w.file);
  return lab_writing_end(&w);
}

int lab_template_file(const char *path, const char *const *piece, const cJSON *values, lab_error *error)
{
  char *text = lab_template_text(piece);
  lab_outfile out;
  int status = text ? lab_out_open(&out, path, error) : lab_fail_memory(error, path);
  if (status == LAB_OK)
    status = lab_out_end(&out, lab_template_write(out.file, text, values, error), error);
  free(text);
  return status;
}
