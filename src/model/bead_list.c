/* bead_list.c - the beads of a list: what each says of its own, and the setup of one bead, which takes the rest from the
 * scene. */
#include "model/bead_list.h"

#include "base/error.h"
#include "model/bead_rows.h"
#include "model/forms.h"
#include "model/params.h"

const fst_bead_params *fst_bead_own(const fst_params *params, int bead)
{
    if (bead < 0 || bead >= params->bead_count)
        return NULL;
    return params->bead_count > FST_BEADS_MOST ? &params->bead_list[bead] : &params->beads[bead];
}

fst_status fst_bead_may_set(fst_params *params, int bead, fst_error *error)
{
    const int count = params->bead_count;
    if (bead >= 0 && count > FST_BEADS_MOST)
        return fst_fail(
            error, FST_BAD_INPUT, "beads",
            "beads[%d]: the scene lists %d beads, and those of a list of more than %d have no keys of "
            "their own: change the list",
            bead, count, FST_BEADS_MOST);
    if (bead > count)
        return fst_fail(
            error, FST_BAD_INPUT, "beads",
            "beads[%d]: the scene lists %d bead%s, counted from beads[0]: a key of beads[%d] adds one", bead,
            count, count == 1 ? "" : "s", count);
    if (bead == count) {
        params->beads[bead] = fst_bead_says_nothing();
        ++params->bead_count;
    }
    return FST_OK;
}

void fst_bead_was_set(fst_params *params, int bead, const fst_param_info *row)
{
    const char *key = fst_bead_key_of_setup(row->key);
    for (int i = 0; i < FST_BEAD_FIELDS; ++i) {
        const fst_param_info *other = fst_bead_row(bead * FST_BEAD_FIELDS + i);
        if (fst_params_clash(params, key, fst_bead_key_of_setup(other->key)))
            fst_param_put(params, other, other->initial);
    }
}

fst_status fst_params_of_bead(const fst_params *params, int bead, fst_params *alone, fst_error *error)
{
    const fst_bead_params *own = fst_bead_own(params, bead);
    fst_params said = *params;
    if (!own)
        return fst_fail(error, FST_BAD_INPUT, "beads",
                        "the scene lists %d beads, counted from beads[0], and beads[%d] is none of them",
                        params->bead_count, bead);
    said.beads[0] = *own;
    fst_status status = fst_params_settle(&said, error);
    *alone = said;
    alone->bead_count = 0;
    alone->bead_list = NULL;
    for (int i = 0; i < FST_BEAD_FIELDS && status == FST_OK; ++i) {
        const char *key = fst_bead_key_of_setup(fst_bead_row(i)->key);
        const double value = fst_param_value(&said, fst_bead_row(i));
        if (fst_bead_row(i)->kind == FST_KIND_CHOICE ? value == FST_BEAD_NO_CHOICE : isnan(value))
            continue;
        fst_form_will_be_set(alone, key);
        fst_param_put(alone, fst_param_at(fst_param_find(key)), value);
        fst_form_was_set(alone, key);
    }
    return status;
}

fst_status fst_beads_validate(const fst_params *params, fst_error *error)
{
    const int count = params->bead_count;
    if (count < 0 || count > FST_BEADS_MANY || (count > FST_BEADS_MOST && !params->bead_list))
        return fst_fail(error, FST_BAD_INPUT, "beads", "bead_count is %d: it must be 0 to %d%s", count,
                        FST_BEADS_MANY, count > FST_BEADS_MOST ? ", of a bead_list" : "");
    fst_status status = FST_OK;
    for (int bead = 0; bead < count && status == FST_OK; ++bead) {
        const int keyed = count <= FST_BEADS_MOST;
        fst_params said = *params;
        said.beads[keyed ? bead : 0] = *fst_bead_own(params, bead);
        for (int i = 0; i < FST_BEAD_FIELDS && status == FST_OK; ++i)
            status = fst_param_validate(&said, fst_bead_row((keyed ? bead : 0) * FST_BEAD_FIELDS + i), error);
    }
    return status;
}
