/* run_image.c - a run that is not over, as bytes from which it goes on to the same bits. */
#define _GNU_SOURCE /* dl_iterate_phdr() */
#include "study/run_image.h"

#include <link.h>
#include <stdlib.h>
#include <string.h>

#include "study/settle.h"

typedef struct image {
    uint64_t layout;
    fst_run_place place;
    int numbers;
    fst_window window;
    fst_run_end end;
    fst_settling settling;
    fst_exponent exponent; /* of a parked run */
    fst_flow flow;
} image;

/* ------------------------------------------------------------------ which build this is */

static uint64_t add_bytes(uint64_t hash, const void *bytes, size_t size) /* FNV-1a */
{
    for (const unsigned char *b = bytes, *end = b + size; b < end; ++b)
        hash = (hash ^ *b) * 0x100000001b3u;
    return hash;
}

typedef struct build_notes {
    uintptr_t address; /* of something in the object that is looked for */
    uint64_t hash;
    int found;
} build_notes;

/* Take the build's identity, which the linker made of all of its content, out of a segment of notes. */
static void read_notes(build_notes *s, const unsigned char *notes, size_t size)
{
    enum { HEAD = 3 * sizeof(uint32_t) };
    for (size_t at = 0; at + HEAD <= size && !s->found;) {
        uint32_t head[3]; /* size of the name, size of what is noted, its type */
        memcpy(head, notes + at, HEAD);
        const size_t name = (head[0] + 3u) & ~(size_t)3, noted = (head[1] + 3u) & ~(size_t)3;
        if (name > size || noted > size || at + HEAD + name + noted > size)
            return;
        if (head[2] == NT_GNU_BUILD_ID && head[0] == 4 && memcmp(notes + at + HEAD, "GNU", 4) == 0) {
            s->hash = add_bytes(s->hash, notes + at + HEAD + name, head[1]);
            s->found = 1;
        }
        at += HEAD + name + noted;
    }
}

static int look_at_object(struct dl_phdr_info *object, size_t size, void *user)
{
    (void)size;
    build_notes *s = user;
    int here = 0;
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const uintptr_t from = object->dlpi_addr + object->dlpi_phdr[i].p_vaddr;
        here |= object->dlpi_phdr[i].p_type == PT_LOAD && s->address >= from &&
                s->address < from + object->dlpi_phdr[i].p_memsz;
    }
    for (int i = 0; here && i < object->dlpi_phnum; ++i)
        if (object->dlpi_phdr[i].p_type == PT_NOTE)
            read_notes(s,
                       (const unsigned char *)(object->dlpi_addr + object->dlpi_phdr[i].p_vaddr), /* NOLINT */
                       object->dlpi_phdr[i].p_memsz);
    return here;
}

/* The build and the sizes as a number; 0 where the build has no identity. */
static uint64_t layout(int numbers)
{
    static const char here = 0;
    build_notes s = {.address = (uintptr_t)&here, .hash = 0xcbf29ce484222325u};
    (void)dl_iterate_phdr(look_at_object, &s);
    const size_t sizes[] = {sizeof(image), sizeof(fst_window), sizeof(fst_flow), (size_t)numbers};
    const uint64_t hash = add_bytes(s.hash, sizes, sizeof sizes);
    return s.found ? hash | 1u : 0u;
}

int fst_run_images_possible(void)
{
    return layout(0) != 0;
}

/* ------------------------------------------------------------------ making, taking */

void *fst_run_image_make(const fst_watched_run *run, const fst_exponent *exponent, const fst_run_place *place,
                         int numbers, double **lane, size_t *size)
{
    *size = sizeof(image) + (size_t)numbers * sizeof **lane;
    image *made = calloc(1, *size);
    if (!made)
        return NULL;
    made->layout = layout(numbers);
    made->place = *place;
    made->numbers = numbers;
    made->window = run->window;
    made->end = run->end;
    made->settling = run->settling;
    made->flow = *run->flow;
    if (exponent) {
        made->exponent = *exponent;
        made->exponent.world = NULL;
    }
    *lane = (double *)(made + 1);
    return made;
}

static int is_sound_series(const fst_mark_series *s)
{
    return s->count >= 0 && s->count <= FST_MARKS && s->stride >= 1 && s->offered >= 0;
}

static int are_sound(const fst_swings *s)
{
    return is_sound_series(&s->marks) && s->seen >= 0 && s->seen <= FST_SWINGS_PAST && s->maxima >= 0 &&
           s->maxima <= FST_SWINGS_PAST;
}

static int is_sound(const image *i, uint64_t expected, int numbers, size_t size)
{
    const int count =
        i->place.station == FST_STATION_RUN_UP || i->place.station == FST_STATION_OBSERVED ? numbers : 0;
    return expected != 0 && i->layout == expected && i->numbers == count &&
           size == sizeof *i + (size_t)count * sizeof(double) &&
           (unsigned)i->place.station < FST_STATION_COUNT &&
           (i->place.station == FST_STATION_ALONE) ==
               (numbers == 0 && i->place.station != FST_STATION_PARKED) &&
           is_sound_series(&i->window.returns.marks) && is_sound_series(&i->window.periods) &&
           are_sound(&i->window.swings) && fst_settling_is_sound(&i->settling);
}

/* Whether a run under this law may have such modes. */
static int are_possible(const fst_modes_double *m, const fst_kinds *kinds)
{
    const int flies = m->contact == FST_MODE_FLIGHT,
              begins = m->contact == FST_MODE_ONSET || m->contact == FST_MODE_CREEP;
    const int sticks = m->contact == FST_MODE_STICK, rests = m->rolling == FST_ROLL_RESTS;
    const int of_contact =
        m->contact == FST_MODE_SLIP || (kinds->modes && (sticks || begins)) || (kinds->flies && flies);
    const int of_rolling =
        m->rolling == FST_ROLL_ROLLS || (kinds->resists && (rests || m->rolling == FST_ROLL_STARTS));
    return of_contact && of_rolling;
}

int fst_run_image_take(const void *bytes, size_t size, int numbers, fst_watched_run *run,
                       fst_exponent *exponent, fst_run_place *place, const double **lane)
{
    if (!bytes || size < sizeof(image))
        return 0;
    const image *from = bytes;
    if (!is_sound(from, layout(from->numbers == 0 ? 0 : numbers), numbers, size))
        return 0;
    const fst_world_double world = *fst_flow_world(run->flow);
    if (!are_possible(fst_flow_modes(&from->flow), &world.kinds))
        return 0;
    const fst_groups groups = run->flow->groups;
    run->window = from->window;
    run->window.groups = groups;
    run->end = from->end;
    run->settling = from->settling;
    *run->flow = from->flow;
    *FST_WORLD(&run->flow->step) = world;
    run->flow->groups = groups;
    run->flow->step.context.outside = NULL; /* no run has one */
    *place = from->place;
    if (place->station == FST_STATION_PARKED) {
        *exponent = from->exponent;
        exponent->world = fst_flow_world(run->flow);
    }
    *lane = (const double *)(from + 1);
    return 1;
}
