/* What was found, in the words of a person: "The chamber leaks: 0.0137 mm², 1.5 % of the fill orifice, 36 Nl/h at 4 bar
 * supply."
 * SPDX-License-Identifier: MIT */
#ifndef LAB_EFFECT_SENTENCE_H
#define LAB_EFFECT_SENTENCE_H

#include "../rig/rig.h"

enum { LAB_EFFECT_SENTENCE = 256 };

/* Fill in pneu_effect_sentence of an effect. A part between commas whose size is not finite is left out.
 * In:      rig    with the effect
 *          param  the parameter of the effect that has its size, as in pneu_param_describe
 * Out:     text   Returns: text */
const char *lab_effect_sentence(const lab_rig *rig, int effect, int param, char text[LAB_EFFECT_SENTENCE]);

/* Whether a name may stand in braces in a sentence. */
int lab_effect_size_is_known(const char *name, size_t length);

#endif
