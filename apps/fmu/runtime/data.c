#include "data.h"
#include "model_data.h"

const fmu_data fmu_model_data = {FMU_MARK, MODEL_TOKEN, MODEL_PARAMS, MODEL_LAWS, MODEL_N_TERMS, MODEL_TERMS};
