/* branch_read.c - reading back the branches that fst_branch_write() wrote.
 *
 * The file may have been edited, cut short, or made by another program.  So every member is checked against the
 * values that it may have, and the first wrong one ends the reading with a sentence that names it.  Nothing is
 * guessed: most members have a value (0, a fold) that a guess would turn into a wrong result.
 */
#include <festoon/festoon_tools.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "host/regular_file.h"
#include "io/branch_points.h"
#include "io/json.h"

enum { MOST_BRANCHES = 1000000 };

/* A file being read.  After the first wrong member nothing more is read. */
typedef struct reader {
    const char *path;
    const char *key; /* the branch's parameter, which is also that of its special points */
    char place[48];  /* the object that is being read, as in "points[3]." */
    int branches;    /* every number of a branch is less */
    fst_branch_kind kind;
    fst_status status;
    fst_error *error;
} reader;

static void refuse(reader *r, const char *key, const json_t *found, const char *expected)
{
    if (r->status != FST_OK)
        return;
    char shown[FST_QUOTE_SIZE] = "what it is";
    if (!found) {
        r->status = fst_fail(r->error, FST_BAD_INPUT, r->path, "%s%s is missing: it must be %s", r->place, key,
                             expected);
        return;
    }
    if (json_is_string(found)) {
        (void)fst_quote(json_string_value(found), shown);
    } else {
        char *text = json_dumps(found, JSON_ENCODE_ANY | JSON_COMPACT | JSON_ENSURE_ASCII);
        if (text)
            (void)snprintf(shown, sizeof shown, "%.60s%s", text, strlen(text) > 60 ? "..." : "");
        free(text);
    }
    r->status =
        fst_fail(r->error, FST_BAD_INPUT, r->path, "%s%s must be %s, not %s", r->place, key, expected, shown);
}

static void read_number(reader *r, const json_t *object, const char *key, double *out)
{
    const json_t *found = json_object_get(object, key);
    if (!json_is_number(found) && !json_is_null(found))
        refuse(r, key, found, "a number or null");
    *out = json_is_number(found) ? json_number_value(found) : NAN;
}

static void read_finite(reader *r, const json_t *object, const char *key, double *out)
{
    const json_t *found = json_object_get(object, key);
    if (!json_is_number(found))
        refuse(r, key, found, "a number");
    *out = json_number_value(found);
}

/* An integer from `least` to `most`. */
static int read_integer(reader *r, const json_t *object, const char *key, int least, int most)
{
    const json_t *found = json_object_get(object, key);
    const json_int_t value = json_integer_value(found);
    char expected[64];
    (void)snprintf(expected, sizeof expected, "an integer from %d to %d", least, most);
    if (!json_is_integer(found) || value < least || value > most) {
        refuse(r, key, found, expected);
        return least;
    }
    return (int)value;
}

static int read_flag(reader *r, const json_t *object, const char *key)
{
    const json_t *found = json_object_get(object, key);
    if (!json_is_boolean(found))
        refuse(r, key, found, "true or false");
    return json_is_true(found);
}

/* The number of a branch; -1 for null, which means none. */
static int read_branch_or_none(reader *r, const json_t *object, const char *key)
{
    return json_is_null(json_object_get(object, key)) ? -1 : read_integer(r, object, key, 0, r->branches - 1);
}

/* The place of a text among names; 0 where it is not among them (the reading has then ended). */
static int read_name(reader *r, const json_t *object, const char *key, const char *names)
{
    const json_t *found = json_object_get(object, key);
    const char *text = json_string_value(found);
    char expected[400];
    const int place = text && strlen(text) == json_string_length(found) ? fst_name_place(text, names) : -1;
    if (place >= 0)
        return place;
    (void)snprintf(expected, sizeof expected, "one of %s", names);
    refuse(r, key, found, expected);
    return 0;
}

/* A symmetry by its name; null: there is none. */
static fst_symmetry read_symmetry(reader *r, const json_t *object)
{
    const json_t *found = json_object_get(object, "symmetry");
    const char *text = json_string_value(found);
    for (int i = FST_SYMMETRY_S1; text && i < FST_SYMMETRY_COUNT; ++i)
        if (strcmp(text, fst_symmetry_name((fst_symmetry)i)) == 0)
            return (fst_symmetry)i;
    if (!json_is_null(found))
        refuse(r, "symmetry", found, "\"S1\", \"S2\" or null");
    return FST_SYMMETRY_NONE;
}

/* The key of a parameter with real values.  Its name goes into figures. */
static void read_parameter(reader *r, const json_t *object, const char *key, char out[64])
{
    const json_t *found = json_object_get(object, key);
    const char *text = json_string_value(found);
    const int row = text && strlen(text) == json_string_length(found) ? fst_param_find(text) : -1;
    out[0] = '\0';
    if (row >= 0 && fst_param_at(row)->kind == FST_KIND_REAL)
        (void)snprintf(out, 64, "%s", fst_param_at(row)->key);
    else
        refuse(r, key, found, "a key of the scene with real values, as \"drive.omega\"");
}

/* A positive number of the scene; NAN where there is none. */
static double scale_of(const json_t *document, const char *key)
{
    const json_t *found = json_object_get(json_object_get(document, "scene"), key);
    const double value = json_number_value(found);
    return value > 0.0 && isfinite(value) ? value : NAN;
}

/* Set all that an object says: "magnet": {"parts": [{"kind": "block"}]} is magnet.parts[0].kind.  What these parameters
 * do not have, of another version, says nothing here. */
static void read_scene(const json_t *value, const char *key, fst_params *scene)
{
    char inner[128], text[64];
    const char *name;
    const json_t *each;
    size_t i;
    json_object_foreach((json_t *)value, name, each)
    {
        (void)snprintf(inner, sizeof inner, "%.60s%s%.60s", key, key[0] ? "." : "", name);
        read_scene(each, inner, scene);
    }
    json_array_foreach(value, i, each)
    {
        (void)snprintf(inner, sizeof inner, "%.100s[%zu]", key, i);
        read_scene(each, inner, scene);
    }
    if (json_is_number(value)) {
        (void)snprintf(text, sizeof text, "%.17g", json_number_value(value));
        (void)fst_params_set(scene, key, text, NULL);
    } else if (json_is_string(value)) {
        (void)fst_params_set(scene, key, json_string_value(value), NULL);
    }
}

/* A text that goes into messages, without control characters. */
static void read_text(reader *r, const json_t *object, const char *key, char *out, size_t size)
{
    const json_t *found = json_object_get(object, key);
    const char *text = json_string_value(found);
    const size_t length = json_string_length(found);
    int fit = text && length < size && strlen(text) == length;
    for (size_t i = 0; fit && i < length; ++i)
        fit = (unsigned char)text[i] >= 0x20 && text[i] != 0x7f;
    if (fit)
        memcpy(out, text, length + 1);
    else
        refuse(r, key, found, "a short text without control characters");
}

/* ---------------------------------------------------------------- a point */

static void read_list_of_pairs(reader *r, const char *key, const json_t *list, size_t count, double *res,
                               double *ims)
{
    for (size_t i = 0; i < count; ++i) {
        const json_t *pair = json_array_get(list, i);
        const json_t *re = json_array_get(pair, 0), *im = json_array_get(pair, 1);
        if (json_array_size(pair) != 2 || !(json_is_number(re) || json_is_null(re)) ||
            !(json_is_number(im) || json_is_null(im)))
            refuse(r, key, pair, "pairs of two numbers");
        res[i] = json_is_number(re) ? json_number_value(re) : NAN;
        ims[i] = json_is_number(im) ? json_number_value(im) : NAN;
    }
}

static void read_pairs(reader *r, const json_t *object, fst_branch_point *p)
{
    const json_t *found = json_object_get(object, "multipliers"),
                 *other = json_object_get(object, "eigenvalues");
    const char *key = other ? "eigenvalues" : "multipliers";
    const size_t count = json_array_size(other ? other : found);
    const size_t most = r->kind == FST_BRANCH_DRIVEN ? FST_EIGENVALUE_COUNT : FST_MULTIPLIER_COUNT;
    if ((found && other) ||
        !(json_is_array(other) ? count == FST_EIGENVALUE_COUNT : json_is_array(found) && count <= most)) {
        refuse(r, key, other ? other : found, "8 multipliers, or 9 eigenvalues instead, each of two numbers");
        return;
    }
    p->multipliers = (int)count;
    read_list_of_pairs(r, key, other ? other : found, count, p->multiplier_re, p->multiplier_im);
}

static void read_numbers(reader *r, const json_t *object, const char *key, double *out, size_t count)
{
    const json_t *found = json_object_get(object, key);
    char expected[32];
    int fit = json_array_size(found) == count;
    for (size_t i = 0; i < count; ++i) {
        const json_t *number = json_array_get(found, i);
        fit = fit && (json_is_number(number) || json_is_null(number));
        out[i] = json_is_number(number) ? json_number_value(number) : NAN;
    }
    (void)snprintf(expected, sizeof expected, "%zu numbers", count);
    if (!fit)
        refuse(r, key, found, expected);
}

static void read_levitation(reader *r, const json_t *object, fst_levitation *l)
{
    const json_t *pairs = json_object_get(object, "eigenvalues_per_s");
    read_numbers(r, object, "position_m", l->position_m, 3);
    read_numbers(r, object, "w", l->w_per_s, 3);
    read_number(r, object, "height_mm", &l->height_mm);
    read_number(r, object, "tilt_deg", &l->tilt_deg);
    read_number(r, object, "circle_mm", &l->circle_mm);
    read_number(r, object, "gap_mm", &l->gap_mm);
    l->stable = read_flag(r, object, "stable");
    l->family = read_flag(r, object, "family");
    if (json_array_size(pairs) != FST_LEVITATION_DIRECTIONS)
        refuse(r, "eigenvalues_per_s", pairs, "11 pairs of two numbers");
    read_list_of_pairs(r, "eigenvalues_per_s", pairs, FST_LEVITATION_DIRECTIONS, l->eigenvalue_re,
                       l->eigenvalue_im);
    for (int i = 0; i < FST_LEVITATION_DIRECTIONS && !l->stable; ++i)
        l->unstable += l->eigenvalue_re[i] > 0.0;
    read_number(r, object, "residual", &l->residual);
    read_numbers(r, object, "state", l->state, FST_BEAD_NUMBERS);
}

static void read_point(reader *r, const json_t *object, fst_branch_point *p)
{
    if (!json_is_object(object)) {
        refuse(r, "", object, "an object");
        return;
    }
    for (int i = 0; i < FST_POINT_NUMBER_COUNT; ++i) {
        double value;
        read_number(r, object, fst_point_numbers[i].key, &value);
        memcpy((char *)p + fst_point_numbers[i].offset, &value, sizeof value);
    }
    p->symmetry = read_symmetry(r, object);
    p->stable = read_flag(r, object, "stable");
    p->turns = read_integer(r, object, "turns", -MOST_BRANCHES, MOST_BRANCHES);
    p->branch = read_integer(r, object, "branch", 0, r->branches - 1);
    p->levitation.height_mm = p->levitation.tilt_deg = p->levitation.circle_mm = p->levitation.gap_mm = NAN;
    if (r->kind == FST_BRANCH_LEVITATING) {
        read_levitation(r, object, &p->levitation);
        return;
    }
    read_pairs(r, object, p);
    if (r->kind == FST_BRANCH_DRIVEN)
        read_numbers(r, object, "state", p->levitation.state, FST_BEAD_NUMBERS);
    else
        read_numbers(r, object, "state", p->state, FST_STATE_SIZE);
}

/* ---------------------------------------------------------------- special points, ends */

static void read_special(reader *r, const json_t *object, fst_special *s)
{
    if (!json_is_object(object)) {
        refuse(r, "", object, "an object");
        return;
    }
    const json_t *criticality = json_object_get(object, "criticality"),
                 *parameter = json_object_get(object, "parameter");
    const char *side = json_string_value(criticality), *key = json_string_value(parameter);
    s->type = (fst_special_type)read_name(r, object, "type", FST_WORDS(FST_SPECIALS));
    if (!key || strcmp(key, r->key) != 0)
        refuse(r, "parameter", parameter, "the branch's own parameter");
    read_number(r, object, "value", &s->value);
    read_number(r, object, "omega", &s->omega);
    s->branch = read_integer(r, object, "branch", 0, r->branches - 1);
    if (side && strcmp(side, "supercritical") == 0)
        s->criticality = 1;
    else if (side && strcmp(side, "subcritical") == 0)
        s->criticality = -1;
    else if (!json_is_null(criticality))
        refuse(r, "criticality", criticality, "\"supercritical\", \"subcritical\" or null");
    s->born = read_branch_or_none(r, object, "born");
    const size_t length = strlen(r->place);
    (void)snprintf(r->place + length, sizeof r->place - length, "at.");
    read_point(r, json_object_get(object, "at"), &s->at);
}

static void read_end(reader *r, const json_t *object, fst_branch_end *end, int over_two)
{
    if (!json_is_object(object)) {
        refuse(r, "", object, "an object");
        return;
    }
    const json_t *image = json_object_get(object, "image_under_s2");
    const char *which = json_string_value(image);
    end->branch = read_integer(r, object, "branch", 0, r->branches - 1);
    end->family = read_branch_or_none(r, object, "born_on");
    read_number(r, object, "value", &end->value);
    if (json_object_get(object, "type")) /* older files do not have it */
        end->type = (fst_end_type)read_name(r, object, "type", FST_WORDS(FST_ENDS));
    read_text(r, object, "reason", end->reason, sizeof end->reason);
    if (over_two || (which && strcmp(which, "not listed") == 0))
        end->image = -1;
    else if (which && strcmp(which, "itself") == 0)
        end->image = end->branch;
    else if (json_is_integer(image))
        end->image = read_integer(r, object, "image_under_s2", 0, r->branches - 1);
    else
        refuse(r, "image_under_s2", image, "\"itself\", \"not listed\" or the number of a branch");
}

/* ---------------------------------------------------------------- the whole file */

/* Older files do not hold the number of branches: take it from their points and ends. */
static int count_branches(const json_t *document)
{
    static const char *const lists[] = {"points", "ends", "specials", "crossings"};
    json_int_t most = -1;
    for (size_t k = 0; k < sizeof lists / sizeof *lists; ++k) {
        const json_t *list = json_object_get(document, lists[k]);
        for (size_t i = 0; i < json_array_size(list); ++i) {
            const json_t *item = json_array_get(list, i);
            const json_int_t branch = json_integer_value(json_object_get(item, "branch"));
            const json_int_t born = json_integer_value(json_object_get(item, "born"));
            most = branch > most ? branch : most;
            most = born > most ? born : most;
        }
    }
    return most < MOST_BRANCHES ? (int)most + 1 : MOST_BRANCHES;
}

static void read_head(reader *r, const json_t *document, fst_branch *branch)
{
    branch->kind = (fst_branch_kind)read_name(r, document, "kind", FST_WORDS(FST_BRANCH_KINDS));
    read_parameter(r, document, "parameter", branch->key);
    read_finite(r, document, "from", &branch->from);
    branch->half_length = scale_of(document, "magnet.half_length");
    branch->gamma = scale_of(document, "friction.gamma");
    if (json_is_object(json_object_get(document, "scene")) && (branch->scene = malloc(sizeof *branch->scene))) {
        *branch->scene = fst_default_params();
        read_scene(json_object_get(document, "scene"), "", branch->scene);
    }
    read_finite(r, document, "to", &branch->to);
    if (json_object_get(document, "second_parameter")) {
        read_parameter(r, document, "second_parameter", branch->second_key);
        read_finite(r, document, "second_from", &branch->second_from);
        read_finite(r, document, "second_to", &branch->second_to);
        branch->followed = (fst_special_type)read_name(r, document, "followed", FST_WORDS(FST_SPECIALS));
    }
    branch->complete = read_flag(r, document, "complete");
    branch->branches = json_object_get(document, "branches")
                           ? read_integer(r, document, "branches", 0, MOST_BRANCHES)
                           : count_branches(document);
    r->key = branch->key;
    r->kind = branch->kind;
    r->branches = branch->branches;
}

/* A list of the document, and the number of its elements in *count. */
static const json_t *list_of(reader *r, const json_t *document, const char *key, size_t *count)
{
    const json_t *list = json_object_get(document, key);
    if (!json_is_array(list))
        refuse(r, key, list, "a list");
    *count = json_array_size(list);
    return list;
}

static void read_lists(reader *r, const json_t *document, fst_branch *branch)
{
    size_t points, specials, crossings, ends;
    const json_t *point = list_of(r, document, "points", &points);
    const json_t *special = list_of(r, document, "specials", &specials);
    const json_t *crossing = list_of(r, document, "crossings", &crossings);
    const json_t *end = list_of(r, document, "ends", &ends);
    branch->points = calloc(points + 1, sizeof *branch->points);
    branch->specials = calloc(specials + crossings + 1, sizeof *branch->specials);
    branch->ends = calloc(ends + 1, sizeof *branch->ends);
    if (!branch->points || !branch->specials || !branch->ends) {
        r->status = fst_fail(r->error, FST_NO_MEMORY, r->path, "out of memory");
        return;
    }
    for (size_t i = 0; i < points && r->status == FST_OK; ++i) {
        (void)snprintf(r->place, sizeof r->place, "points[%zu].", i);
        read_point(r, json_array_get(point, i), &branch->points[branch->point_count++]);
    }
    for (size_t i = 0; i < specials + crossings && r->status == FST_OK; ++i) {
        const int is_crossing = i >= specials;
        (void)snprintf(r->place, sizeof r->place, "%s[%zu].", is_crossing ? "crossings" : "specials",
                       is_crossing ? i - specials : i);
        fst_special *s = &branch->specials[branch->special_count++];
        read_special(r, is_crossing ? json_array_get(crossing, i - specials) : json_array_get(special, i), s);
    }
    for (size_t i = 0; i < ends && r->status == FST_OK; ++i) {
        (void)snprintf(r->place, sizeof r->place, "ends[%zu].", i);
        read_end(r, json_array_get(end, i), &branch->ends[branch->end_count++], branch->second_key[0] != 0);
    }
}

/* The document in a file; NULL: r->status says why there is none. */
static json_t *load(reader *r)
{
    char *text;
    size_t size;
    r->status = fst_read_regular(r->path, FST_LONGEST_JSON, &text, &size, r->error);
    if (r->status != FST_OK)
        return NULL;
    json_error_t why;
    json_t *document = fst_json_read(text, size, &why, &r->status);
    free(text);
    if (r->status == FST_NO_MEMORY) {
        (void)fst_fail(r->error, r->status, r->path, "out of memory");
    } else if (!document) {
        char quoted[FST_QUOTE_SIZE];
        r->status = fst_fail(r->error, FST_BAD_INPUT, r->path, "line %d: this is not JSON: %s", why.line,
                             fst_quote(why.text, quoted));
    } else if (!json_is_object(document) || !json_object_get(document, "points") ||
               !json_object_get(document, "parameter")) {
        r->status =
            fst_fail(r->error, FST_BAD_INPUT, r->path, "this is not a branch: fst_branch_write() makes one");
    }
    return document;
}

fst_status fst_branch_read(const char *path, fst_branch *branch, fst_error *error)
{
    reader r = {.path = path, .key = "", .status = FST_OK, .error = error};
    memset(branch, 0, sizeof *branch);
    json_t *document = load(&r);
    if (r.status == FST_OK)
        read_head(&r, document, branch);
    if (r.status == FST_OK)
        read_lists(&r, document, branch);
    json_decref(document);
    if (r.status != FST_OK)
        fst_branch_free(branch);
    return r.status;
}
