/* bead.c - the spot of the bead's area that is nearest to where the bead should be. */
#include "follow/bead.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

#define LEAST_AREA 0.55 /* of the bead's: a spot with less is cut off, or something else */
#define MOST_AREA 1.8
#define FAR 3.0       /* a spot so many times as far as the bead may be is not the bead */
#define FORGET 8.0    /* lost for so many frames, the bead may be anywhere */
#define TWIN_LEVELS 2 /* a frame whose pixels are all within so many levels of the one before is the same */

fst_status follow_bead_begin(follow_bead *follower, follow_blobs *blobs, const follow_look *look,
                             fst_error *error)
{
    const size_t size = (size_t)blobs->still->width * (size_t)blobs->still->height;
    *follower = (follow_bead){.blobs = blobs,
                              .look = look,
                              .before = malloc(size),
                              .gains = malloc((size_t)blobs->still->height * sizeof *follower->gains)};
    return follower->before && follower->gains
               ? FST_OK
               : fst_fail(error, FST_NO_MEMORY, "track", "no memory for a frame");
}

void follow_bead_end(follow_bead *follower)
{
    free(follower->before);
    free(follower->gains);
    follower->before = NULL;
    follower->gains = NULL;
}

/* Where the bead should be, and how far from there it may be; 0: nothing is known. */
static double expect(const follow_bead *f, double time, double *column, double *row)
{
    if (f->seen == 0)
        return 0.0;
    *column = f->last[0].column;
    *row = f->last[0].row;
    if (f->seen == 1)
        return 0.0;
    const double step = f->when[0] - f->when[1], ahead = time - f->when[0];
    if (!(step > 0.0) || ahead > FORGET * step)
        return 0.0;
    const double across = (f->last[0].column - f->last[1].column) / step * ahead;
    const double down = (f->last[0].row - f->last[1].row) / step * ahead;
    *column += across;
    *row += down;
    return 2.0 * f->look->diameter + 1.5 * hypot(across, down);
}

/* How badly a spot fits: by its area, and by its distance from where the bead should be. */
static double misfit(const follow_bead *f, const follow_cover *cover, double reach, double column, double row)
{
    const double area = 2.0 * fabs(log(cover->area / f->look->area));
    return reach > 0.0 ? area + hypot(cover->column - column, cover->row - row) / reach : area;
}

/* A frame that shows the same as the one before, but for what compression changed. */
static int is_twin(const follow_bead *f, const unsigned char *frame)
{
    const size_t size = (size_t)f->blobs->still->width * (size_t)f->blobs->still->height;
    enum { PIECE = 4096 };
    for (size_t from = 0; from < size; from += PIECE) {
        const size_t to = from + PIECE < size ? from + PIECE : size;
        int most = 0;
        for (size_t i = from; i < to; ++i) {
            const int off = abs(frame[i] - f->before[i]);
            most = off > most ? off : most;
        }
        if (most > TWIN_LEVELS)
            return 0;
    }
    return 1;
}

static fst_status choose(follow_bead *f, const unsigned char *frame, double time, follow_place *place,
                         fst_error *error)
{
    double column = 0.0, row = 0.0, best = INFINITY;
    const double reach = expect(f, time, &column, &row);
    for (int i = 0; i < f->blobs->count; ++i) {
        const follow_box *box = &f->blobs->boxes[i];
        follow_cover cover;
        if (box->pixels < 0.3 * f->look->area || box->pixels > 20.0 * f->look->area)
            continue;
        const fst_status status = follow_blobs_cover(f->blobs, frame, f->gains, f->look, box, &cover, error);
        if (status != FST_OK)
            return status;
        if (cover.cut || !(cover.area > LEAST_AREA * f->look->area && cover.area < MOST_AREA * f->look->area))
            continue;
        if (reach > 0.0 && hypot(cover.column - column, cover.row - row) > FAR * reach)
            continue;
        const double bad = misfit(f, &cover, reach, column, row);
        if (bad < best) {
            best = bad;
            *place = (follow_place){cover.column + f->look->shift[0], cover.row + f->look->shift[1],
                                    cover.narrow, 0};
        }
    }
    return FST_OK;
}

int follow_bead_see(follow_bead *follower, const unsigned char *frame)
{
    const size_t size = (size_t)follower->blobs->still->width * (size_t)follower->blobs->still->height;
    const int twin = follower->frames++ > 0 && is_twin(follower, frame);
    memcpy(follower->before, frame, size);
    follow_still_gains(follower->blobs->still, frame, follower->gains);
    for (int row = 0; row < follower->blobs->still->height; ++row)
        follower->gains[row] *= (float)(1.0 - follower->look->shade);
    follow_blobs_find(follower->blobs, frame, follower->gains, follower->look->sign, follower->look->threshold);
    return twin;
}

fst_status follow_bead_next(follow_bead *follower, const unsigned char *frame, double time, follow_place *place,
                            fst_error *error)
{
    const int twin = follow_bead_see(follower, frame);
    *place = (follow_place){NAN, NAN, NAN, 0};
    const fst_status status = choose(follower, frame, time, place, error);
    if (status != FST_OK)
        return status;
    place->twin = twin;
    if (!isnan(place->column) && !place->twin) {
        follower->last[1] = follower->last[0];
        follower->when[1] = follower->when[0];
        follower->last[0] = *place;
        follower->when[0] = time;
        follower->seen += follower->seen < 2;
    }
    return FST_OK;
}
