/* No model: export-fmu writes this file anew for each. */
/* clang-format off */
#define MODEL_TOKEN ""
#define MODEL_PARAMS {.area = 0}
#define MODEL_LAWS {0, 0, 0, 0}
#define MODEL_N_TERMS 0
#define MODEL_TERMS {{0, 0, 0, 0, 0, {0}}}
